// a count -> its color on a scale of heat

// None, 1, 2 and 3, and so on: each begins at twice the number of the one before, and the last has no end.
const HEATS = array<vec3f, 12>(
    vec3f(0.0, 0.0, 0.0),
    vec3f(0.01, 0.01, 0.06),
    vec3f(0.02, 0.03, 0.2),
    vec3f(0.03, 0.1, 0.5),
    vec3f(0.02, 0.3, 0.6),
    vec3f(0.02, 0.45, 0.3),
    vec3f(0.15, 0.6, 0.05),
    vec3f(0.6, 0.7, 0.02),
    vec3f(0.9, 0.45, 0.02),
    vec3f(0.9, 0.15, 0.02),
    vec3f(0.7, 0.02, 0.15),
    vec3f(1.0, 0.75, 0.9),
);

fn heat_of(count: u32) -> vec3f {
    var heats = HEATS;
    return heats[min(32u - countLeadingZeros(count), 11u)];
}
