// a float -> the same float, from which no compiler may conclude anything
#import "tables/settings.wgsl"

// As raster/hold, with the zero of the tracer's settings.
fn hold(x: f32) -> f32 {
    return bitcast<f32>(bitcast<u32>(x) ^ settings.zero);
}
