//! What is told of a pixel is what the picture is made of: to the bit, for random pixels of every scene.

use twinlight::cpu::grays::grays;
use twinlight::cpu::raster::CpuRaster;
use twinlight::explain::{Error, Explainer, Explanation, Samples, Seen, Traced, TracedSample, Way};
use twinlight::film::Film;
use twinlight::math::Vec3;
use twinlight::prepare::draw;
use twinlight::raster;
use twinlight::scene::{Method, Reach, Scene, Show, load};
use twinlight::trace::BLOCK;

use super::{Dice, on_cpu, random_scene, root, scenes, small, tables_of};

fn film_of(scene: &Scene, method: Method) -> Film {
    if method == Method::Trace {
        return on_cpu(&tables_of(scene));
    }
    let mut drawing = draw(scene);
    grays(scene, &mut drawing);
    let Ok(film) = raster::frame(&mut CpuRaster::new(&drawing), &drawing, &mut |_| ());
    film
}

/// The last line of the text.
fn last_line(told: &Explanation) -> ([f32; 3], [u8; 3]) {
    let text = told.to_string();
    let line = text.lines().last().expect("a line");
    let (linear, shown) = line.strip_prefix("linear ").and_then(|l| l.split_once(" -> 8 bits ")).expect(line);
    let linear: Vec<f32> = linear.split(' ').map(|x| x.parse().expect(line)).collect();
    let shown: Vec<u8> = shown.split(' ').map(|x| x.parse().expect(line)).collect();
    (linear.try_into().expect(line), shown.try_into().expect(line))
}

/// Whether what is told ends in the film's own pixel, bit by bit, and adds up to it.
fn right(told: &Explanation, film: &Film, scene: &Scene) -> Result<(), String> {
    let [x, y] = told.pixel;
    let color = film.color(y * film.width() + x).to_array();
    let shown = film.to_rgb8(scene.film.transfer).get_pixel(x, y).0;
    let (linear, written) = last_line(told);
    if linear.map(f32::to_bits) != color.map(f32::to_bits) || written != shown {
        return Err(format!("{x},{y}: {linear:?} {written:?} instead of {color:?} {shown:?}"));
    }
    // Each sample's color, and what its terms make.
    let colors: Vec<(Vec3, Vec3)> = match &told.samples {
        Samples::Raster(all) => {
            let of = |seen: Option<&Seen>| seen.map_or(scene.film.background, color_of);
            all.iter().map(|sample| (sample.color, of(sample.seen.as_ref()))).collect()
        }
        Samples::Trace(all) => all.iter().map(|sample| (sample.color, light_of(sample))).collect(),
    };
    let block = |all: &[(Vec3, Vec3)]| all.iter().fold(Vec3::ZERO, |sum, (color, _)| sum + *color);
    let sum = colors.chunks(BLOCK as usize).fold(Vec3::ZERO, |sum, all| sum + block(all));
    if (sum / colors.len() as f32).to_array() != color {
        return Err(format!("{x},{y}: the samples' mean is another"));
    }
    if let Some((color, made)) = colors.into_iter().find(|(color, made)| color != made) {
        return Err(format!("{x},{y}: the terms make {made}, not {color}"));
    }
    let fits = match &told.samples {
        Samples::Raster(all) => all.iter().filter_map(|sample| sample.seen.as_ref()).try_for_each(geometry),
        Samples::Trace(all) => all.iter().try_for_each(tree),
    };
    fits.map_err(|what| format!("{x},{y}: {what}"))
}

/// The light that arrives and the background's, ray by ray.
fn light_of(sample: &TracedSample) -> Vec3 {
    sample.rays.iter().fold(Vec3::ZERO, |sum, ray| {
        let lights = ray.meets.iter().flat_map(|meeting| &meeting.lights).filter(|light| light.arrives);
        let sum = lights.fold(sum, |sum, light| sum + light.color);
        ray.background.map_or(sum, |light| sum + light)
    })
}

/// Rays are where their parents have sent them, and what hits are told lies on the rays.
fn tree(sample: &TracedSample) -> Result<(), String> {
    for ray in &sample.rays {
        let sent = ray.parent.map(|parent| &sample.rays[parent as usize]);
        let sent = sent.map(|parent: &Traced| {
            let ways = parent.meets.iter().flat_map(|meeting| &meeting.ways);
            let way = ways.clone().find(|way| way.way == ray.way && way.followed);
            let near = parent.meets.as_ref().is_some_and(|meeting| meeting.point.distance(ray.origin) < 1e-3);
            way.is_some_and(|way| way.direction == ray.direction && way.weight == ray.weight) && near
        });
        if sent == Some(false) || (sent.is_none() && ray.way != Way::Primary) {
            return Err(format!("nobody has sent {ray:?}"));
        }
        let Some(meeting) = &ray.meets else { continue };
        let off = meeting.point.distance(ray.origin + ray.direction * meeting.t);
        if off > 1e-3 * (1.0 + meeting.t) || meeting.normal.dot(ray.direction) > 1e-6 {
            return Err(format!("{meeting:?} is {off} off its ray"));
        }
        if let Some(light) = meeting.lights.iter().find(|l| l.before && l.arrives == l.blocker.is_some()) {
            return Err(format!("{light:?}"));
        }
    }
    let followed = |ray: &Traced| ray.meets.iter().flat_map(|m| &m.ways).filter(|way| way.followed).count();
    let children: usize = sample.rays.iter().map(followed).sum();
    if children + 1 != sample.rays.len() {
        return Err(format!("{} rays, and {children} were sent", sample.rays.len()));
    }
    Ok(())
}

/// The spec's sum of what the lights are told to give.
fn color_of(seen: &Seen) -> Vec3 {
    let lights = seen.lights.iter().map(|lit| (lit.term.diffuse, lit.term.specular));
    let (diffuse, specular) = lights.fold((Vec3::ZERO, Vec3::ZERO), |sum, each| (sum.0 + each.0, sum.1 + each.1));
    (diffuse + specular) * seen.fragment.albedo + seen.ambient
}

/// The equations that the figures stand beside.
fn geometry(seen: &Seen) -> Result<(), String> {
    let told = &seen.fragment;
    let weights = told.weights.to_array().map(f64::from);
    if let Some(on_film) = &seen.on_film {
        let inside = on_film.edges.iter().all(|edge| *edge >= 0.0);
        // Eq. 1.1 to 1.5: corners on the film are snapped, which is much of a face of few pixels.
        let unsnapped = on_film.edges.iter().sum::<f64>() > 50.0;
        let corrected = [0, 1, 2].map(|i| f64::from(seen.z) * on_film.weights[i] / f64::from(told.clip[i].w));
        let near = corrected.iter().zip(weights).all(|(a, b)| (a - b).abs() < 0.02);
        if !inside || (unsnapped && !near) {
            return Err(format!("{on_film:?} and {weights:?}"));
        }
    }
    let [a, b, c] = seen.corners;
    if (a * told.weights.x + b * told.weights.y + c * told.weights.z - told.point).length() > 1e-3 {
        return Err("Eq. 1.5".to_owned());
    }
    for lit in &seen.lights {
        let Some(shadow) = &lit.shadow else { continue };
        let Some(texel) = shadow.sight.texel.filter(|texel| texel.asked == 1) else { continue };
        let open = shadow.stored.is_none_or(|stored| texel.depth <= stored);
        if open != (lit.term.share == 1.0) || shadow.stored.is_some() != shadow.caster.is_some() {
            return Err(format!("{shadow:?} and a share of {}", lit.term.share));
        }
    }
    Ok(())
}

/// Random pixels of a picture.
pub(super) fn pixels(seed: u32, [width, height]: [u32; 2], count: u32) -> impl Iterator<Item = [u32; 2]> {
    let mut dice = Dice(seed, 0);
    (0..count).map(move |_| [dice.below(width as usize) as u32, dice.below(height as usize) as u32])
}

#[test]
fn random_pixels_of_every_scene_end_as_they_are_rendered() {
    for (path, seed) in scenes().iter().zip(0..) {
        let size = [97, 61];
        let mut scene = small(path, size, 4);
        for (method, blur) in [(Method::Raster, 0), (Method::Raster, 1), (Method::Trace, 0)] {
            scene.raster.blur = blur;
            let film = film_of(&scene, method);
            let explainer = Explainer::new(&scene, method, &Reach::default()).expect("an explainer");
            for pixel in pixels(seed, size, 12) {
                let told = explainer.pixel(pixel).expect("a pixel");
                right(&told, &film, &scene).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
            }
        }
    }
}

#[test]
fn random_scenes_are_told_as_they_are_traced() {
    for number in 0..40 {
        let mut scene = random_scene(number);
        // More samples than are summed in one block.
        scene.trace.samples = if number % 8 == 0 { 70 } else { 3 };
        let film = film_of(&scene, Method::Trace);
        let explainer = Explainer::new(&scene, Method::Trace, &Reach::default()).expect("an explainer");
        for pixel in pixels(number, scene.film.size, 6) {
            let told = explainer.pixel(pixel).expect("a pixel");
            right(&told, &film, &scene).unwrap_or_else(|e| panic!("random scene {number}: {e}"));
        }
    }
}

#[test]
fn what_is_not_right_is_seen() {
    let mut scene = small(&root().join("scenes/bust.toml"), [97, 61], 4);
    scene.raster.blur = 0;
    let film = film_of(&scene, Method::Raster);
    let wrong = |change: &dyn Fn(&mut Scene)| {
        let mut other = scene.clone();
        change(&mut other);
        let explainer = Explainer::new(&other, Method::Raster, &Reach::default()).expect("an explainer");
        pixels(7, [97, 61], 40).any(|at| right(&explainer.pixel(at).expect("a pixel"), &film, &scene).is_err())
    };
    assert!(!wrong(&|_| ()));
    assert!(wrong(&|scene| scene.raster.ambient.x = scene.raster.ambient.x.next_up()));
    assert!(wrong(&|scene| scene.raster.shadow += 0.01));
    assert!(wrong(&|scene| scene.raster.samples = 1));
    // One term of one light left out, one weight moved, one verdict turned.
    let explainer = Explainer::new(&scene, Method::Raster, &Reach::default()).expect("an explainer");
    let faults: [&dyn Fn(&mut Seen); 3] = [
        &|seen| seen.lights[0].term.diffuse.y *= 0.5,
        &|seen| seen.fragment.weights = Vec3::new(1.5, -0.5, 0.0),
        &|seen| seen.lights[0].term.share = 1.0 - seen.lights[0].term.share,
    ];
    for (number, fault) in faults.iter().enumerate() {
        let seen = pixels(7, [97, 61], 40).any(|at| {
            let mut told = explainer.pixel(at).expect("a pixel");
            let Samples::Raster(samples) = &mut told.samples else { return false };
            samples[1].seen.iter_mut().for_each(fault);
            right(&told, &film, &scene).is_err()
        });
        assert!(seen, "fault {number}");
    }
    // The same of the ray tracer.
    let scene = small(&root().join("scenes/room.toml"), [97, 61], 4);
    let film = film_of(&scene, Method::Trace);
    let explainer = Explainer::new(&scene, Method::Trace, &Reach::default()).expect("an explainer");
    let faults: [&dyn Fn(&mut TracedSample); 5] = [
        &|_| (),
        &|sample| drop(sample.rays.pop()),
        &|sample| sample.rays.iter_mut().for_each(|ray| ray.weight *= 0.5),
        &|sample| sample.rays.iter_mut().flat_map(|ray| &mut ray.meets).for_each(|meeting| meeting.t *= 1.1),
        &|sample| {
            let meetings = sample.rays.iter_mut().flat_map(|ray| &mut ray.meets);
            meetings.for_each(|meeting| meeting.lights.iter_mut().for_each(|light| light.arrives = true));
        },
    ];
    for (number, fault) in faults.iter().enumerate() {
        let seen = pixels(7, [97, 61], 40).any(|at| {
            let mut told = explainer.pixel(at).expect("a pixel");
            let Samples::Trace(samples) = &mut told.samples else { return false };
            fault(&mut samples[1]);
            right(&told, &film, &scene).is_err()
        });
        assert_eq!(seen, number > 0, "fault {number} of a tree");
    }
}

#[test]
fn what_is_shown_instead_of_colors_is_explained_too() {
    let mut scene = small(&root().join("scenes/stones.toml"), [61, 43], 4);
    for show in [Show::Depth, Show::Normal, Show::Id, Show::Shadow, Show::Uv, Show::Wire] {
        scene.raster.show = show;
        let film = film_of(&scene, Method::Raster);
        let explainer = Explainer::new(&scene, Method::Raster, &Reach::default()).expect("an explainer");
        for [x, y] in pixels(3, [61, 43], 8) {
            let told = explainer.pixel([x, y]).expect("a pixel");
            assert_eq!(told.linear, film.color(y * 61 + x), "{show:?}");
        }
    }
    scene.raster.show = Show::Tiles;
    assert_eq!(Explainer::new(&scene, Method::Raster, &Reach::default()).err(), Some(Error::Tiles));
    scene.raster.show = Show::Steps;
    assert_eq!(Explainer::new(&scene, Method::Trace, &Reach::default()).err(), Some(Error::Steps));
}

#[test]
fn what_keeps_the_light_away_is_named_whichever_side_it_shows() {
    let folder = tempfile::tempdir().expect("a folder");
    let quad = "v -1 0 1\nv 1 0 1\nv 1 0 -1\nv -1 0 -1\nf 1 2 3 4\n";
    std::fs::write(folder.path().join("quad.obj"), quad).expect("written");
    let text = r#"
        camera = { position = [0.3, 1, 1.5], look_at = [0.3, 0, 0] }
        film = { size = [9, 9] }
        light.directional = [{ toward = [0, 1, 0] }]
        material = [{ name = "white" }]
        [[object.plane]]
        point = [0, 0, 0]
        normal = [0, 1, 0]
        material = "white"
        [[object.mesh]]
        path = "quad.obj"
        translate = [0, 2, 0]
        scale = 2
        [[object.mesh]]
        path = "quad.obj"
        translate = [0, 3, 0]
        scale = 2
    "#;
    let file = folder.path().join("scene.toml");
    std::fs::write(&file, text).expect("written");
    let mut scene = load(&file).expect("a scene");
    // From below, both quads show their backs.
    for one_sided in [[false, false], [true, false], [false, true], [true, true]] {
        for (mesh, one_sided) in scene.meshes.iter_mut().zip(one_sided) {
            mesh.one_sided = one_sided;
        }
        let explainer = Explainer::new(&scene, Method::Trace, &Reach::default()).expect("an explainer");
        let told = explainer.pixel([4, 4]).expect("a pixel");
        let Samples::Trace(samples) = told.samples else { panic!("it was traced") };
        let floor = samples[0].rays[0].meets.as_ref().expect("the floor");
        assert_eq!(floor.thing.object, "object.plane[0]");
        let light = &floor.lights[0];
        let blocker = light.blocker.as_ref().map(|thing| thing.object.as_str());
        assert_eq!((light.arrives, blocker), (false, Some("object.mesh[0]")), "one-sided: {one_sided:?}");
    }
}
