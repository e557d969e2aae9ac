//! a sample of the rasterizer -> words

use std::fmt;

use super::{Page, maps, number, numbers, thing, vector};
use crate::explain::{DrawnSample, Lit, Seen, Shadow};
use crate::tables::DEEP;

pub(super) fn sample(page: &mut Page<'_, '_>, sample: &DrawnSample, i: usize, count: usize) -> fmt::Result {
    page.say("")?;
    page.say(&format!("sample {i} of {count}, at {}, {}", sample.at.x, sample.at.y))?;
    page.depth += 1;
    match &sample.seen {
        Some(seen) => self::seen(page, seen)?,
        None => page.row("sees", "the background", "")?,
    }
    page.row("color", &vector(sample.color), "color")?;
    if sample.seen.is_some() {
        page.row("", "    = (I_diffuse + I_specular) diffuse + Ambient, summed over the lights", "")?;
    }
    page.depth -= 1;
    Ok(())
}

fn depth(depth: u32) -> String {
    format!("{:.9}", f64::from(depth) / f64::from(DEEP))
}

fn seen(page: &mut Page<'_, '_>, seen: &Seen) -> fmt::Result {
    let told = &seen.fragment;
    page.row("sees", &thing(&seen.thing), "")?;
    for (corner, name) in seen.corners.iter().zip(["A in space", "B", "C"]) {
        page.row(name, &vector(*corner), "")?;
    }
    let z = told.clip.map(|c| f64::from(c.w));
    if let Some(on_film) = &seen.on_film {
        for (place, name) in on_film.places.iter().zip(["A on the film", "B", "C"]) {
            page.row(name, &numbers(&place.to_array()), if name == "C" { "places" } else { "" })?;
        }
        page.row("edges", &(numbers(&on_film.edges) + "   all >= 0: inside"), "edges")?;
        page.row("alpha' beta' gamma'", &numbers(&on_film.weights), "edges")?;
    } else {
        page.row("on the film", "cut at a plane of the view: not all corners are on it", "")?;
    }
    page.row("Z of A, B, C", &numbers(&z), "clip")?;
    page.row("alpha beta gamma", &vector(told.weights), "weights")?;
    page.row("Z", &numbers(&[f64::from(seen.z)]), "z")?;
    page.row(
        "depth less bias",
        &format!("{:>12}   0 is the near plane, 1 the far one", depth(seen.depth)),
        "depth",
    )?;
    page.row("point", &vector(told.point), "point")?;
    page.row("u, v", &numbers(&told.uv.to_array().map(f64::from)), "uv")?;
    maps(page, &seen.maps, seen.tangents)?;
    page.row("diffuse", &vector(told.albedo), "albedo")?;
    page.row("specular weight", &vector(told.specular), "specular")?;
    page.row("exponent k", &numbers(&[f64::from(told.exponent)]), "exponent")?;
    page.row("N", &vector(told.smooth), "smooth")?;
    page.row("normal n", &vector(told.normal), "normal")?;
    page.row("to the eye v", &vector(told.view), "view")?;
    for light in &seen.lights {
        lit(page, light)?;
    }
    page.row("Ambient", &vector(seen.ambient), "ambient")
}

fn lit(page: &mut Page<'_, '_>, lit: &Lit) -> fmt::Result {
    let term = &lit.term;
    page.row(&lit.light, "", "")?;
    page.depth += 1;
    page.row("I_0", &vector(lit.intensity), "")?;
    page.row("to the light l", &vector(term.toward), "toward")?;
    match &lit.shadow {
        Some(shadow) => self::shadow(page, shadow)?,
        None => page.row("shadow", "this light casts none", "")?,
    }
    if term.phong == [0.0; 2] {
        page.row("I_diffuse, I_specular", "           0   n l is not above zero: the light is behind", "diffuse")?;
    } else {
        page.row("I_0, after shadow", &vector(term.power), "share")?;
        page.row("cos theta", &numbers(&[f64::from(term.phong[0])]), "diffuse")?;
        page.row("cos^k alpha", &numbers(&[f64::from(term.phong[1])]), "phong")?;
        page.row("I_diffuse", &vector(term.diffuse), "diffuse")?;
        page.row("I_specular", &vector(term.specular), "phong")?;
    }
    page.depth -= 1;
    Ok(())
}

fn shadow(page: &mut Page<'_, '_>, shadow: &Shadow) -> fmt::Result {
    if !shadow.map.is_empty() {
        page.row("shadow map", &format!("    of {}", shadow.map), "texel")?;
    }
    let clip = shadow.sight.clip;
    let at = clip.truncate() / clip.w;
    page.row("seen by the light at", &vector(at), "texel")?;
    let Some(texel) = shadow.sight.texel else {
        return page.row("shadow", "outside of what the light sees: lit", "texel");
    };
    let side = shadow.side;
    page.row("texel", &format!("    {}, {} of {side}x{side}", texel.column, texel.row), "texel")?;
    page.row("depth", &format!("{:>12}", depth(texel.depth)), "texel")?;
    match (shadow.stored, shadow.bias, &shadow.caster) {
        (Some(stored), Some(bias), Some(caster)) => {
            let verdict =
                if texel.depth <= stored { "nothing is nearer: lit" } else { "something is nearer: shadowed" };
            let figures = format!("{:>12}   {verdict}", depth(stored));
            page.row("depth stored there", &figures, "texel")?;
            page.row("  of its slope", &format!("{:>12}", depth(bias)), "")?;
            page.row("  of", &thing(caster), "")?;
        }
        _ => page.row("depth stored there", "nothing was drawn: lit", "texel")?,
    }
    let share = f64::from(texel.open) / f64::from(texel.asked);
    let asked = if texel.asked > 1 { format!("   of {} texels around", texel.asked) } else { String::new() };
    page.row("share that arrives", &format!("{:>12}{asked}", number(share)), "share")
}
