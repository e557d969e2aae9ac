// a float -> the same float, from which no compiler may conclude anything
#import "tables/lens.wgsl"

// The number itself; but a compiler cannot know that, and so neither fuses nor rearranges what it is made of.
fn hold(x: f32) -> f32 {
    return bitcast<f32>(bitcast<u32>(x) ^ lens.zero);
}
