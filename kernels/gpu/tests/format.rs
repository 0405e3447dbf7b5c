//! `docs/format.md` against the types that it describes.

#![cfg(feature = "kernels")]

use std::mem::offset_of;
use std::ops::Range;

use lightbvh::light::{AnyLight, DiscLight, Light, PointLight, RectangleLight, SphereLight, SpotLight};
use lightbvh::node::{LinkedSpotMomentNode, SpotMomentNode};
use lightbvh::{
    CompactNode, EmissiveTriangle, Instance, LightBvh, MomentNode, SampledLight, TreeWords,
    TwoSidedMomentNode,
};
use lightbvh_gpu::{Access, DeviceBuffer, KERNELS};

const PAGE: &str = include_str!("../../../docs/format.md");

/// The cells of the rows of the first table below `heading`.
fn table(heading: &str) -> Vec<Vec<&'static str>> {
    let below = PAGE
        .split_once(heading)
        .unwrap_or_else(|| panic!("no {heading}"))
        .1;
    let rows = below.lines().skip_while(|line| !line.starts_with('|'));
    let rows = rows.take_while(|line| line.starts_with('|')).skip(2);
    rows.map(|row| row.split('|').skip(1).map(str::trim).collect())
        .collect()
}

/// "3" or "3 to 5".
fn range(cell: &str) -> Range<usize> {
    let number = |text: &str| text.parse::<usize>().unwrap_or_else(|_| panic!("{cell}"));
    match cell.split_once(" to ") {
        Some((first, last)) => number(first)..number(last) + 1,
        None => number(cell)..number(cell) + 1,
    }
}

/// Rows without a gap, several of which may be of the same words.
fn length(heading: &str) -> usize {
    table(heading).iter().fold(0, |end, row| {
        let own = range(row[0]);
        assert!(own.start == end || own.end == end, "{heading}: {row:?}");
        own.end
    })
}

fn code(cell: &str) -> &str {
    cell.trim_matches('`')
}

#[test]
fn layouts_have_their_words() {
    let sizes = [
        ("MomentNode<8>", size_of::<MomentNode<8>>(), 8),
        ("MomentNode<16>", size_of::<MomentNode<16>>(), 16),
        ("TwoSidedMomentNode<8>", size_of::<TwoSidedMomentNode<8>>(), 8),
        ("SpotMomentNode<8>", size_of::<SpotMomentNode<8>>(), 8),
        ("LinkedSpotMomentNode<8>", size_of::<LinkedSpotMomentNode<8>>(), 8),
        ("CompactNode<4>", size_of::<CompactNode<4>>(), 4),
    ];
    let rows = table("\n## Nodes\n");
    assert_eq!(rows.len(), sizes.len());
    for (row, (name, bytes, width)) in rows.iter().zip(sizes) {
        assert_eq!(code(row[0]), name);
        assert_eq!(range(row[2]).start * 4, bytes, "{name}");
        assert_eq!(range(row[1]).start * 4 * width, bytes, "{name}");
        let (layout, _) = name.split_once('<').expect("a width");
        let heading = format!("\n### `{layout}`\n");
        assert_eq!(length(&heading) * 4 * width, bytes, "{name}");
    }
}

/// The bits of each row of a packed layout, from the highest to the lowest.
#[test]
fn bits_of_a_row_are_told_once() {
    for layout in ["MomentNode", "CompactNode"] {
        let mut end: Option<(usize, usize)> = None;
        for row in table(&format!("\n### `{layout}`\n")) {
            let at = range(row[0]).start;
            let is_bits = row[1].starts_with(|c: char| c.is_ascii_digit());
            if !is_bits {
                continue;
            }
            let bits = range(row[1]);
            match end {
                Some((before, low)) if before == at => assert_eq!(bits.end, low, "{layout}: {row:?}"),
                Some((_, low)) => assert_eq!(low, 0, "{layout}: {row:?}"),
                None => {}
            }
            end = Some((at, bits.start));
        }
        assert_eq!(end.map(|(_, low)| low), Some(0), "{layout}");
    }
}

/// Words of a record, and where each of its fields begins.
fn record(name: &str, bytes: usize, fields: &[(&str, usize)]) {
    let heading = format!("\n### {name}\n");
    assert_eq!(length(&heading) * 4, bytes, "{name}");
    let rows = table(&heading);
    for &(field, offset) in fields {
        let row = rows.iter().find(|row| code(row[1]) == field);
        let row = row.unwrap_or_else(|| panic!("{name} has no {field}"));
        assert_eq!(range(row[0]).start * 4, offset, "{name}.{field}");
    }
    assert_eq!(
        rows.iter().filter(|row| !row[1].is_empty()).count(),
        fields.len(),
        "{name}"
    );
}

macro_rules! record {
    ($type:ident: $($field:ident),*) => {
        record(
            concat!("`", stringify!($type), "`"),
            size_of::<$type>(),
            &[$((stringify!($field), offset_of!($type, $field))),*],
        )
    };
}

#[test]
fn records_have_their_fields() {
    record!(Instance: root, blas, first, first_light, count, listed, columns, translation, inverse, per_inverse, flux, radiance, mask,
        mirrored);
    record!(EmissiveTriangle: p, radiance, mesh, flags);
    record!(SampledLight: light, instance, pmf);
    record!(TreeWords: root, trail_words, live, lights, depth, top, above, places, parts);
    record("Query", 32, &[("p", 0), ("n", 12)]);
}

/// Their fields in order, without a gap, `mesh` where files leave it out.
#[test]
fn lights_of_other_kinds_have_their_words() {
    let rows = table("\n### Lights of other kinds\n");
    let mut left = rows.iter();
    macro_rules! light {
        ($type:ident: $($field:ident),*) => {
            let row = left.next().expect("a row");
            assert_eq!(code(row[0]), stringify!($type));
            assert_eq!(range(row[1]).start * 4, size_of::<$type>(), "{row:?}");
            let fields = [$((stringify!($field), offset_of!($type, $field))),*];
            let told = row[2].split(", ").map(|cell| code(cell.split(' ').next().unwrap_or(cell)));
            assert!(told.eq(fields.map(|(name, _)| name)), "{row:?}");
            assert!(fields.is_sorted_by_key(|&(_, offset)| offset), "{row:?}");
            assert_eq!(offset_of!($type, mesh), <$type>::MESH_WORD * 4);
        };
    }
    light!(PointLight: p, intensity, range, mesh);
    light!(SpotLight: p, intensity, axis, cos_inner, cos_outer, range, mesh);
    light!(SphereLight: p, radius, radiance, mesh);
    light!(RectangleLight: p, half, radiance, mesh, flags);
    light!(DiscLight: p, half, radiance, mesh, flags);
    let row = left.next().expect("a row");
    assert_eq!(
        (code(row[0]), range(row[1]).start * 4),
        ("AnyLight", size_of::<AnyLight>())
    );
    assert!(left.next().is_none());
}

/// Each buffer of the page has the strides, readers and writers that kernels say.
#[test]
fn buffers_have_their_strides_readers_and_writers() {
    let rows = table("\n## Buffers\n");
    for buffer in DeviceBuffer::ALL {
        assert!(rows.iter().any(|row| code(row[0]) == buffer.name()), "{buffer:?}");
    }
    for kernel in KERNELS {
        let (name, layout) = ["_eq4", "_any", "_linked", "_cell"]
            .into_iter()
            .find_map(|suffix| Some((kernel.name.strip_suffix(suffix)?, suffix)))
            .unwrap_or((kernel.name, ""));
        for binding in kernel.bindings {
            let names = |row: &&Vec<&str>| row[0].split(", ").any(|name| code(name) == binding.name);
            let Some(row) = rows.iter().find(names) else {
                continue;
            };
            // By layout, by kernel, or alike for all.
            let strides: Vec<&str> = row[1].split([',', ';']).map(str::trim).collect();
            let of = |what: &str| {
                strides
                    .iter()
                    .find_map(|own| own.strip_prefix(&*format!("`{what}` ")))
            };
            let stride = of(layout).or_else(|| of(name)).unwrap_or(strides[0]);
            if !["samples", "numbers"].contains(&binding.name) {
                assert_eq!(stride.parse(), Ok(binding.stride), "{name}: {binding:?}");
            }
            let cell = row[if binding.access == Access::Read { 3 } else { 2 }];
            let mut names = cell.split([';', ',']).map(|name| code(name.trim()));
            let is_named = names.any(|own| {
                own == name
                    || own == kernel.name
                    || own.strip_suffix('*').is_some_and(|start| name.starts_with(start))
            });
            assert!(is_named, "{} uses {binding:?}", kernel.name);
        }
    }
}

#[test]
fn files_begin_with_their_header() {
    let words = LightBvh::default().to_words();
    let header = length("\n## Files\n");
    let at = |what: &str| {
        let rows = table("\n## Files\n");
        let row = rows.iter().find(|row| row[1].starts_with(what));
        words[range(row.unwrap_or_else(|| panic!("no {what}"))[0]).start]
    };
    assert_eq!(at("\"LBVH\""), u32::from_le_bytes(*b"LBVH"));
    assert_eq!(at("`FORMAT`"), lightbvh::bvh::FORMAT);
    assert_eq!(at("number of all words"), words.len() as u32);
    assert_eq!((at("`W`"), at("length of the array of nodes of the top")), (8, 1));
    // Behind it the one node of the top level: whether it is in use, its half extents, where it was put, its kinds.
    assert_eq!(words.len(), header + 1 + 3 + 3 + 1);
    let versions = [
        "lightbvh::node::NODE_FORMAT`, now ",
        "lightbvh::bvh::FORMAT`, now ",
    ];
    for (text, version) in versions
        .iter()
        .zip([lightbvh::node::NODE_FORMAT, lightbvh::bvh::FORMAT])
    {
        assert!(PAGE.contains(&*format!("{text}{version},")), "{text}");
    }
}
