//! Hostile files through the real command: a picture or a sentence, within two seconds and 512 MiB.

mod corpus;
mod pictures;

use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use corpus::Corpus;

/// What a run may take; the machine's other work is forgiven.
const SECONDS: u64 = 2;
const MIB: u64 = 512;

/// Ends as what, after how long, and with how much memory.
fn outcome(folder: &Path, file: &str, heavy: bool) -> (Option<i32>, Duration, u64, String) {
    let start = Instant::now();
    // Far more address space than memory is asked for: what a thread's stack reserves is not used.
    let model = Path::new(file).extension().is_some_and(|e| e == "obj");
    let command = if heavy {
        format!("check {file}")
    } else {
        let set = if model { "" } else { "--set trace.seed=1" };
        format!("render {file} -o out.png --size 16x12 --samples 1 --frames 1 --backend cpu {set}")
    };
    let binary = env!("CARGO_BIN_EXE_twinlight");
    let script = format!("ulimit -v 4194304; exec {binary} {command} --max-memory 256M");
    let mut child = Command::new("sh")
        .current_dir(folder)
        .args(["-c", &script])
        .stdout(Stdio::null())
        .stderr(fs::File::create(folder.join("words")).expect("a file"))
        .spawn()
        .expect("sh");
    let mut peak = 0;
    let status = loop {
        let about = fs::read_to_string(format!("/proc/{}/status", child.id())).unwrap_or_default();
        // Until it is the program, what is seen is the tests' own memory, of which the child is a copy.
        let begun = about.starts_with("Name:\ttwinlight\n");
        let line = about.lines().filter(|_| begun).find_map(|line| line.strip_prefix("VmHWM:"));
        let kib = line.and_then(|line| line.split_whitespace().next()?.parse::<u64>().ok());
        peak = peak.max(kib.unwrap_or(0) >> 10);
        if let Some(status) = child.try_wait().expect("a child") {
            break status.code();
        }
        if start.elapsed() > Duration::from_mins(1) {
            let _ = child.kill();
            let _ = child.wait();
            break None;
        }
        std::thread::sleep(Duration::from_millis(2));
    };
    let words = fs::read(folder.join("words")).unwrap_or_default();
    (status, start.elapsed(), peak, String::from_utf8_lossy(&words).into_owned())
}

#[cfg(unix)]
#[test]
fn every_hostile_file_ends_in_a_picture_or_a_sentence() {
    let mut corpus = Corpus::default();
    corpus::scenes(&mut corpus);
    corpus::meshes(&mut corpus);
    corpus::models(&mut corpus);
    corpus::materials(&mut corpus);
    pictures::pictures(&mut corpus);
    assert!(corpus.0.len() > 200, "only {} cases", corpus.0.len());
    let mut wrong = Vec::new();
    let (mut drawn, mut refused) = (0, 0);
    for case in &corpus.0 {
        let folder = tempfile::tempdir().expect("a folder");
        let folder = folder.path();
        fs::create_dir(folder.join("folder")).expect("a folder");
        let _ = std::os::unix::fs::symlink("/etc/passwd", folder.join("link"));
        let made = Command::new("mkfifo").arg(folder.join("pipe")).status();
        assert!(made.is_ok_and(|status| status.success()), "mkfifo");
        for (name, bytes) in &case.files {
            fs::write(folder.join(name), bytes).expect("written");
        }
        let (code, mut took, peak, words) = outcome(folder, &case.files[0].0, case.heavy);
        if took > Duration::from_secs(SECONDS) && code.is_some() {
            // Once more, since others use this machine too.
            took = took.min(outcome(folder, &case.files[0].0, case.heavy).1);
        }
        let said = code == Some(0) || words.starts_with("error: ");
        let good = matches!(code, Some(0 | 3 | 6)) && said && peak <= MIB && took.as_secs() < SECONDS;
        if !good {
            let name: String = case.name.chars().take(70).collect();
            let words: String = words.chars().take(300).collect();
            wrong.push(format!("{name:?}: exit {code:?} after {took:.1?} with {peak} MiB: {words}"));
        }
        drawn += u32::from(code == Some(0));
        refused += u32::from(code != Some(0));
    }
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), corpus.0.len(), wrong.join("\n"));
    assert!(drawn > 20 && refused > 60, "{drawn} drawn, {refused} refused");
}
