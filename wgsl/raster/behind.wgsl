// a speck -> nothing, if all that it could show is hidden
#import "raster/speck.wgsl"

#if veiled
@group(0) @binding(3) var veil: Table;

fn unveiled(s: Speck) -> Speck {
    let first = vec2u(s.first) / CELL;
    let further = vec2u(s.last) / CELL - first;
    let row = texel(veil, first.y * lens.columns * (TILE / CELL) + first.x);
    let cells = max(further.x, further.y);
    let few = select(row.x, row.y, cells == 1u);
    let far = select(select(few, row.z, cells == 2u), 0u, cells > 2u);
    let hidden = (s.kind == SMALL) & (bitcast<u32>(s.plan.nears.most) < far);
    return Speck(select(s.kind, NOTHING, hidden), s.first, select(s.last, s.first, hidden), s.plan);
}
#else
fn unveiled(s: Speck) -> Speck {
    return s;
}
#end
