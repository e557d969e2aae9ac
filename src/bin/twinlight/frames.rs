//! `1-240:2`, `1,5,10-20` -> the frames that are meant

/// The most frames of one call.
const MOST: usize = 1_000_000;
const RIGHT: &str = "frames are written as 7, 1-240, 1..240, 1-240:2 or 1,5,10-20";

/// Frames in the order they were written, each once.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Frames(pub(crate) Vec<i64>);

pub(crate) fn frames(text: &str) -> Result<Frames, String> {
    let mut all = Vec::new();
    for part in text.split(',') {
        let (range, step) = match part.split_once(':') {
            Some((range, step)) => (range, number(step)?),
            None => (part, 1),
        };
        let (first, last) = match range.split_once("..").or_else(|| range.split_once('-')) {
            Some((first, last)) => (number(first)?, number(last)?),
            None if part == range => (number(range)?, number(range)?),
            None => return Err(RIGHT.to_owned()),
        };
        if last < first || step == 0 {
            return Err(format!("{part}: the last frame is not before the first, and steps are from 1"));
        }
        let count = ((last - first) / step) as usize + 1;
        if all.len() + count > MOST {
            return Err(format!("{text}: a call makes at most {MOST} frames"));
        }
        all.extend((first..=last).step_by(step as usize));
    }
    let mut seen = std::collections::HashSet::new();
    all.retain(|frame| seen.insert(*frame));
    Ok(Frames(all))
}

fn number(text: &str) -> Result<i64, String> {
    let digits = !text.is_empty() && text.len() <= 9 && text.bytes().all(|b| b.is_ascii_digit());
    digits.then(|| text.parse().ok()).flatten().ok_or_else(|| RIGHT.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_way_to_write_them() {
        let cases: [(&str, &[i64]); 8] = [
            ("7", &[7]),
            ("1-4", &[1, 2, 3, 4]),
            ("1..4", &[1, 2, 3, 4]),
            ("1-9:4", &[1, 5, 9]),
            ("0..8:3", &[0, 3, 6]),
            ("1,5,10-12", &[1, 5, 10, 11, 12]),
            ("3,1-3", &[3, 1, 2]),
            ("1-1", &[1]),
        ];
        for (text, wanted) in cases {
            assert_eq!(frames(text).map(|f| f.0), Ok(wanted.to_vec()), "{text}");
        }
        for wrong in
            ["", "x", "-", "1-", "-3", "1-2-3", "1..", "4-1", "1-9:0", "5:2", "1,,2", "1-9999999", "1e3", "٣"]
        {
            assert!(frames(wrong).is_err(), "{wrong}");
        }
    }
}
