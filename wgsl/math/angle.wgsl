// two sides of a right angle -> how far round a circle their end lies

const EIGHTH: f32 = 0.7853982;
const PER_TURN: f32 = 0.15915494;

// In turns from 0 to 1, from +x by way of +y; 0 in the middle. The arctangent is that of Moshier's Cephes: atanf.
fn turns(x: f32, y: f32) -> f32 {
    let small = min(abs(x), abs(y));
    let large = max(abs(x), abs(y));
    if (large == 0.0) {
        return 0.0;
    }
    // Above tan(pi / 8), what is left to an eighth of a turn.
    let steep = small > large * 0.41421357;
    let q = select(small / large, (small - large) / (small + large), steep);
    let z = q * q;
    let series = ((0.080537446 * z - 0.13877686) * z + 0.19977711) * z - 0.3333295;
    let angle = select(0.0, EIGHTH, steep) + (series * z * q + q);
    var turns = angle * PER_TURN;
    if (abs(y) > abs(x)) {
        turns = 0.25 - turns;
    }
    if (x < 0.0) {
        turns = 0.5 - turns;
    }
    if (y < 0.0) {
        turns = 1.0 - turns;
    }
    return turns;
}
