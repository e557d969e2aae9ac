//! quick
use twinlight::{render::*, gpu::Wanted, scene, film};
fn main() {
    let a: Vec<String> = std::env::args().collect();
    let mut s = match scene::load(a[1].as_ref()) { Ok(s) => s, Err(e) => { eprintln!("{e}"); std::process::exit(3) } };
    if a.len() > 4 { s.trace.depth = a[4].parse().unwrap(); }
    if a.len() > 5 { s.trace.samples = a[5].parse().unwrap(); }
    if a.len() > 6 { s.film.size = [a[6].parse().unwrap(), a[7].parse().unwrap()]; }
    let b = if a[2] == "cpu" { Backend::Cpu } else { Backend::Gpu };
    let mut r = Renderer::open(b, &Wanted::Best).unwrap();
    let out = r.render(&s, scene::Method::Trace, &mut |_| ());
    match out { Ok(o) => {
    println!("{} {:?} {:?}", o.by, o.took, o.notes);
    film::write_whole(a[3].as_ref(), &o.film.to_rgb8(s.film.transfer)).unwrap(); }
    Err(e) => println!("{e}") }
}
