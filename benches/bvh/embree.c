// The peer of `benches/bvh/main.rs`: Embree's single rays. Its interface is declared here by hand, as its wheel has no
// headers.
//
// embree-rays MESH THREADS QUALITY FLAGS [RAYS...]: builds, says how long that took, and then, for each number that it
// reads, sends the rays of that file through the tree and says how long that took and what they met.
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

typedef void *Handle;
extern Handle rtcNewDevice(const char *);
extern Handle rtcNewScene(Handle);
extern void rtcSetSceneBuildQuality(Handle, int);
extern void rtcSetSceneFlags(Handle, int);
extern Handle rtcNewGeometry(Handle, int);
extern void rtcSetSharedGeometryBuffer(Handle, int, unsigned, int, const void *, size_t, size_t, size_t);
extern void rtcCommitGeometry(Handle);
extern unsigned rtcAttachGeometry(Handle, Handle);
extern void rtcCommitScene(Handle);
extern void rtcReleaseScene(Handle);
extern void rtcIntersect1(Handle, void *, void *);
extern void rtcOccluded1(Handle, void *, void *);

struct Ray {
    float origin[3], near, direction[3], time, far;
    unsigned mask, id, flags;
};

// Room to spare at the end: how much of it a build of Embree uses hangs on its options.
struct Hit {
    struct Ray ray;
    float normal[3], u, v;
    unsigned primitive, geometry, rest[16];
} __attribute__((aligned(16)));

// As the bench writes them: the first `far` of a file that asks for any hit is not infinite.
struct Asked {
    float origin[3], far, direction[3];
    uint32_t any;
};

static double now(clockid_t clock) {
    struct timespec t;
    clock_gettime(clock, &t);
    return t.tv_sec + 1e-9 * t.tv_nsec;
}

static void *whole(const char *name, size_t *bytes) {
    FILE *file = fopen(name, "rb");
    if (!file) {
        perror(name);
        exit(1);
    }
    fseek(file, 0, SEEK_END);
    *bytes = ftell(file);
    rewind(file);
    char *data = malloc(*bytes + 16);
    if (fread(data, 1, *bytes, file) != *bytes) exit(1);
    fclose(file);
    return data;
}

int main(int count, char **words) {
    char config[64];
    snprintf(config, sizeof config, "threads=%s", words[2]);
    Handle device = rtcNewDevice(config);
    size_t bytes;
    // Nine floats a triangle.
    float *corners = whole(words[1], &bytes);
    size_t triangles = bytes / 36;
    uint32_t *index = malloc(triangles * 12);
    for (size_t i = 0; i < triangles * 3; i++) index[i] = i;

    Handle scene = 0;
    double best = INFINITY;
    for (int turn = 0; turn < 5; turn++) {
        if (scene) rtcReleaseScene(scene);
        scene = rtcNewScene(device);
        rtcSetSceneBuildQuality(scene, atoi(words[3]));
        rtcSetSceneFlags(scene, atoi(words[4]));
        Handle mesh = rtcNewGeometry(device, 0);
        rtcSetSharedGeometryBuffer(mesh, 0, 0, 0x5003, index, 0, 12, triangles);
        rtcSetSharedGeometryBuffer(mesh, 1, 0, 0x9003, corners, 0, 12, triangles * 3);
        double start = now(CLOCK_MONOTONIC);
        rtcCommitGeometry(mesh);
        rtcAttachGeometry(scene, mesh);
        rtcCommitScene(scene);
        double took = now(CLOCK_MONOTONIC) - start;
        if (took < best) best = took;
    }
    printf("%.9f\n", best);
    fflush(stdout);

    struct Asked *rays[16];
    size_t lengths[16];
    for (int i = 5; i < count; i++) rays[i - 5] = whole(words[i], &lengths[i - 5]);
    int which;
    while (scanf("%d", &which) == 1) {
        size_t n = lengths[which] / sizeof(struct Asked);
        struct Asked *asked = rays[which];
        size_t hits = 0;
        double sum = 0;
        double start = now(CLOCK_THREAD_CPUTIME_ID);
        for (size_t i = 0; i < n; i++) {
            struct Hit hit;
            for (int k = 0; k < 3; k++) {
                hit.ray.origin[k] = asked[i].origin[k];
                hit.ray.direction[k] = asked[i].direction[k];
            }
            hit.ray.near = 0;
            hit.ray.far = asked[i].far;
            hit.ray.time = 0;
            hit.ray.mask = -1;
            hit.ray.id = hit.ray.flags = 0;
            hit.geometry = -1;
            hit.rest[0] = -1;
            if (asked[i].any) {
                rtcOccluded1(scene, &hit.ray, 0);
                hits += hit.ray.far < 0;
            } else {
                rtcIntersect1(scene, &hit, 0);
                if (hit.geometry != (unsigned)-1) {
                    hits++;
                    sum += hit.ray.far;
                }
            }
        }
        double took = now(CLOCK_THREAD_CPUTIME_ID) - start;
        printf("%.9f %zu %.9e\n", took, hits, sum);
        fflush(stdout);
    }
    return 0;
}
