//! Clusters of up to `W` lights that share a prefix of their codes.

use alloc::vec::Vec;

#[cfg(feature = "rayon")]
use rayon::prelude::*;

use super::codes::{BITS, Curve};
use super::radix::{entry, sort};
use crate::build::ward::{DARK, Leaves, NOTHING, WardPrimitive, extent_of};
use crate::emission::MAX_SUM;
use crate::exact::{exponent, min, pow2};

/// The lights of each cluster.
#[derive(Debug)]
pub(in crate::build) struct Clusters {
    /// First light of each cluster, then the number of lights.
    starts: Vec<u32>,
    /// The lights' indices, in the lower halves.
    lights: Vec<u64>,
}

impl Leaves for Clusters {
    const LEVELS: u32 = 1;

    fn count(&self, index: u32) -> usize {
        (self.starts[index as usize + 1] - self.starts[index as usize]) as usize
    }

    fn light(&self, index: u32, k: usize) -> u32 {
        self.lights[self.starts[index as usize] as usize + k] as u32
    }
}

/// The clusters of `primitives`, and one primitive for each of them.
pub(in crate::build) fn clusters<const W: usize>(
    primitives: &[WardPrimitive],
) -> (Clusters, Vec<WardPrimitive>) {
    let curve = Curve::through(&extent_of(primitives));
    let mut sorted = entries(primitives, &curve);
    sort(&mut sorted);
    let starts = starts::<W>(&sorted);
    let centres = centres::<W>(primitives, &mut sorted, &starts);
    (
        Clusters {
            starts,
            lights: sorted,
        },
        centres,
    )
}

fn entries(primitives: &[WardPrimitive], curve: &Curve) -> Vec<u64> {
    let of = |(i, p): (usize, &WardPrimitive)| entry(curve.code(p), i);
    #[cfg(feature = "rayon")]
    if crate::build::ward::is_parallel(primitives.len()) {
        return primitives
            .par_iter()
            .enumerate()
            .with_min_len(crate::build::ward::CHUNK)
            .map(of)
            .collect();
    }
    primitives.iter().enumerate().map(of).collect()
}

/// Where clusters begin, and the number of lights: each is the greatest range of one prefix that holds `W` at most and
/// begins there; of lights of the same code, the first `W`.
fn starts<const W: usize>(sorted: &[u64]) -> Vec<u32> {
    let code = |i: usize| (sorted[i] >> 32) as u32;
    // Common prefix of the codes at two places, in bits; none with a place outside.
    let common = |i: usize, j: usize| {
        if j < sorted.len() {
            ((code(i) ^ code(j)).leading_zeros() as i32) - (32 - BITS as i32)
        } else {
            -1
        }
    };
    let mut starts = Vec::with_capacity(sorted.len() / (W / 2) + 2);
    let (mut i, mut before) = (0, -1);
    while i < sorted.len() {
        starts.push(i as u32);
        let after = common(i, i + W);
        let prefix = (if before > after { before } else { after }) + 1;
        let prefix = if prefix > BITS as i32 { BITS as i32 } else { prefix };
        let mut end = i + 1;
        while end < i + W && common(i, end) >= prefix {
            end += 1;
        }
        before = common(end - 1, end);
        i = end;
    }
    starts.push(sorted.len() as u32);
    starts
}

/// Clusters in a piece of work.
const PIECE: usize = 1024;

/// One primitive for each cluster; the places of primitives in `sorted` become the indices of their lights.
fn centres<const W: usize>(
    primitives: &[WardPrimitive],
    sorted: &mut [u64],
    starts: &[u32],
) -> Vec<WardPrimitive> {
    let mut centres = alloc::vec![NOTHING; starts.len() - 1];
    let mut rest = sorted;
    let mut pieces = Vec::with_capacity(centres.len() / PIECE + 1);
    for (i, out) in centres.chunks_mut(PIECE).enumerate() {
        let starts = &starts[i * PIECE..=i * PIECE + out.len()];
        let count = starts[out.len()] - starts[0];
        let (own, after) = rest.split_at_mut(count as usize);
        rest = after;
        pieces.push((i * PIECE, starts, own, out));
    }
    let fill = |(first, starts, own, out): (usize, &[u32], &mut [u64], &mut [WardPrimitive])| {
        for (k, centre) in out.iter_mut().enumerate() {
            let lights = &mut own[(starts[k] - starts[0]) as usize..(starts[k + 1] - starts[0]) as usize];
            *centre = centre_of::<W>((first + k) as u32, lights, primitives);
        }
    };
    #[cfg(feature = "rayon")]
    if crate::build::ward::is_parallel(primitives.len()) {
        pieces.into_par_iter().for_each(fill);
        return centres;
    }
    pieces.into_iter().for_each(fill);
    centres
}

/// The primitive that stands for the lights of cluster `index`: their centre of flux, or their mean where there is none.
fn centre_of<const W: usize>(index: u32, lights: &mut [u64], primitives: &[WardPrimitive]) -> WardPrimitive {
    // Fetched all at once: they lie anywhere.
    let mut own = [NOTHING; W];
    for (own, light) in own.iter_mut().zip(lights.iter_mut()) {
        *own = primitives[*light as u32 as usize];
        *light = u64::from(own.index);
    }
    let own = &own[..lights.len()];
    let origin = own[0].c;
    let (mut brightest, mut phi) = (0.0, 0.0);
    for p in own {
        brightest = if p.phi > brightest { p.phi } else { brightest };
        phi = min(phi + p.phi, MAX_SUM);
    }
    let per_watt = pow2(-exponent(brightest));
    let (mut sum, mut weight) = ([0.0; 3], 0.0);
    for p in own {
        let w = p.phi * per_watt + DARK;
        for axis in 0..3 {
            sum[axis] += (p.c[axis] - origin[axis]) * w;
        }
        weight += w;
    }
    let centre = |axis: usize| origin[axis] + sum[axis] / weight;
    WardPrimitive {
        c: [centre(0), centre(1), centre(2)],
        phi,
        index,
    }
}
