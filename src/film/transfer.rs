//! linear light <-> the numbers a display is sent

use glam::Vec3;

use crate::math::power::power;

/// How a color becomes a display's number.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, Default, serde::Deserialize, serde::Serialize, schemars::JsonSchema,
)]
#[serde(rename_all = "lowercase")]
pub enum Transfer {
    /// Colors are display-referred: 1 is white, and nothing is done to them. The spec's pictures are made so.
    None,
    /// Colors are linear light, encoded by the sRGB curve (IEC 61966-2-1).
    #[default]
    Srgb,
}

impl Transfer {
    /// The display's number, 0 to 255, for a color part clamped to 0 ... 1.
    #[must_use]
    pub fn encode(self, color: f32) -> u8 {
        // What is not a number becomes 0.
        let c = if color > 0.0 { color.min(1.0) } else { 0.0 };
        let shown = match self {
            Self::None => c,
            Self::Srgb if c <= 0.003_130_8 => c * 12.92,
            Self::Srgb => 1.055 * power(c, 1.0 / 2.4) - 0.055,
        };
        (shown * 255.0 + 0.5) as u8
    }

    /// The color part for a display's number: the inverse of [`encode`](Self::encode).
    #[must_use]
    pub fn decode(self, shown: u8) -> f32 {
        let c = f32::from(shown) / 255.0;
        match self {
            Self::None => c,
            Self::Srgb if c <= 0.040_45 => c / 12.92,
            Self::Srgb => power((c + 0.055) / 1.055, 2.4),
        }
    }
}

/// The color that a display shows for `#rrggbb`.
#[must_use]
pub fn decode_hex(rgb: [u8; 3], transfer: Transfer) -> Vec3 {
    Vec3::from_array(rgb.map(|c| transfer.decode(c)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_decoded_encodes_to_itself() {
        for transfer in [Transfer::None, Transfer::Srgb] {
            for shown in 0..=255 {
                assert_eq!(transfer.encode(transfer.decode(shown)), shown, "{transfer:?}");
            }
        }
        assert_eq!(Transfer::Srgb.encode(0.214_04), 127, "mid grey of the standard");
        assert_eq!([-1.0, 9.0, f32::NAN].map(|c| Transfer::Srgb.encode(c)), [0, 255, 0]);
    }
}
