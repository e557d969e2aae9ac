//! a material as it is written -> one that is checked, with its pictures read

use std::ops::Range;

use glam::Vec2;

use super::Resolver;
use crate::scene::file;
use crate::scene::maps::{Maps, Pictures};
use crate::scene::model::{Content, Map};
use crate::scene::value::At;
use crate::scene::{Behavior, Error, FilmSettings, Material};

impl Resolver<'_> {
    pub(super) fn material(
        &self,
        m: &file::Material,
        film: &FilmSettings,
        pictures: &mut Pictures<'_>,
    ) -> Result<Material, Error> {
        let glass = m.behavior == Behavior::Glass;
        if let (false, Some(refract)) = (glass, &m.refract) {
            return self.refuse(refract, "only a material with behavior = \"glass\" refracts");
        }
        if let (false, Some(index)) = (glass, &m.index) {
            return self.refuse(index, "only a material with behavior = \"glass\" has a refractive index");
        }
        let usual_reflect = if m.behavior == Behavior::Diffuse { 1.0 } else { 0.0 };
        Ok(Material {
            name: m.name.get().clone(),
            color: m.color.under(film.transfer),
            local: m.local.map_or(1.0, |w| w.0),
            reflect: m.reflect.map_or(usual_reflect, |w| w.0),
            refract: m.refract.as_ref().map_or(if glass { 1.0 } else { 0.0 }, |w| w.get().0),
            exponent: m.exponent.0,
            index: m.index.as_ref().map_or(1.5, |i| i.get().0),
            behavior: m.behavior,
            maps: self.maps(m, pictures)?,
        })
    }

    fn maps(&self, m: &file::Material, pictures: &mut Pictures<'_>) -> Result<Maps, Error> {
        let needs = |span: Range<usize>, what: &str| Err((self.complain)(span, what));
        if let (None, Some(bump)) = (&m.normal_map, &m.bump) {
            return needs(bump.span(), "only a material with a `normal_map` has a strength of it");
        }
        let any = m.color_map.is_some() || m.normal_map.is_some() || m.specular_map.is_some();
        if let (false, Some(repeat)) = (any, &m.repeat) {
            return needs(
                repeat.span(),
                "only a material with a `color_map`, `normal_map` or `specular_map` repeats it",
            );
        }
        let scale = m.repeat.as_ref().map_or(Vec2::ONE, |r| Vec2::from_array(r.get().0.map(|n| n.0)));
        let bump = m.bump.as_ref().map_or(1.0, |b| b.get().0);
        let mut map = |file: &Option<At<String>>, content: Content, strength: f32| {
            let read = file.as_ref().map(|file| {
                let map = pictures.map(file.get(), content, strength);
                map.map_err(|why| (self.complain)(file.span(), &why))
            });
            Ok(read.transpose()?.map(|map| Map { scale, ..map }))
        };
        Ok(Maps {
            color: map(&m.color_map, Content::Color, 1.0)?,
            normal: map(&m.normal_map, Content::Normal, bump)?,
            specular: map(&m.specular_map, Content::Color, 1.0)?,
        })
    }
}
