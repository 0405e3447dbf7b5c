//! Meshes that become brighter or dimmer by their lights: the top level was built for other fluxes.
//!
//! A node does not see that it is no longer a good one: lights that outshine all others lie in one of its children, and it
//! tells those apart as well as before. So the nodes above count all that the mesh outshines as built anew, and a rebuilder
//! tries them.

use super::{Bvh, Trails};
use crate::node::Node;
use crate::summary::Summary;
use crate::tree::INVALID;

/// A flux is another one from this factor on.
const FACTOR: f32 = 2.0;
/// What comes in with so many times the usual flux outshines others around it.
const BRIGHT: f64 = 32.0;
/// Each mesh counts as so many instances at least: where one in 32 of a part is such there may be something to gain.
const LEAST: u32 = 4;

/// Flux of a mesh, in its own space, for which the top level was built or is to be built.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct KnownFlux {
    /// W.
    phi: f32,
    /// Whether it was dimmer once: a mesh that blinks is known by its greater flux, and asks for nothing from then on.
    blinks: bool,
}

impl KnownFlux {
    /// That of a mesh that is new.
    pub fn of(phi: f32) -> Self {
        Self { phi, blinks: false }
    }

    /// Takes a flux; of another one than before, the greater of both.
    fn note(&mut self, phi: f32) -> Option<f32> {
        let was = self.phi;
        let is_dimmer = was > FACTOR * phi;
        if phi <= FACTOR * was && (self.blinks || !is_dimmer) {
            return None;
        }
        self.blinks |= is_dimmer;
        self.phi = phi;
        Some(crate::exact::max(was, phi))
    }

    /// How many times as bright it was, where it blinks.
    fn was_brighter(self, phi: f32) -> f64 {
        if self.blinks && self.phi > phi && phi > 0.0 {
            f64::from(self.phi) / f64::from(phi)
        } else {
            1.0
        }
    }

    /// A word of the format: the flux, the sign telling that it blinks.
    pub fn word(self) -> u32 {
        self.phi.copysign(if self.blinks { -1.0 } else { 1.0 }).to_bits()
    }

    /// From such a word; `None` where it is no flux.
    pub fn from_word(word: u32) -> Option<Self> {
        let flux = f32::from_bits(word);
        flux.is_finite().then(|| Self {
            phi: crate::exact::abs(flux),
            blinks: flux.is_sign_negative(),
        })
    }
}

impl<N: Node<W>, I, const W: usize, T: Trails> Bvh<N, I, W, T> {
    /// After a refit of these roots: looks for meshes whose flux is another one. In time in proportion to their instances,
    /// times the depth of the top level, and to nothing where there are none.
    pub(super) fn note_fluxes(&mut self, roots: &[u32]) {
        for &blas in roots {
            let phi = self.root_of(blas).phi();
            // Parts of opened instances have roots of their own, which are looked at with the whole.
            let own = self
                .blases
                .get_mut(blas as usize)
                .filter(|own| !own.nodes.is_empty());
            let Some(own) = own else { continue };
            let Some(greater) = own.known_flux.note(phi) else {
                continue;
            };
            let mesh = own.mesh as usize;
            for user in 0..self.meshes[mesh].users.len() {
                let index = self.meshes[mesh].users[user];
                let flux = f64::from(greater) * f64::from(self.instances[index as usize].flux);
                for leaf in self.leaves_of(index) {
                    self.unsettle_above(self.placed[leaf as usize].node, flux);
                }
            }
        }
    }

    /// By how much a bottom level was brighter, where it blinks: one that was opened for its light is not closed and opened
    /// with it.
    pub(super) fn was_brighter(&self, blas: u32) -> f64 {
        let own = &self.blases[blas as usize];
        own.known_flux.was_brighter(self.root_of(blas).phi())
    }

    /// Whether a bottom level is off and was on before, and has changed since the epoch `rests_since`: it is to be expected back.
    #[cfg(feature = "std")]
    pub(super) fn is_blinking(&self, blas: u32, rests_since: u64) -> bool {
        let own = &self.blases[blas as usize];
        own.known_flux.blinks && own.changed > rests_since && self.root_of(blas).phi() <= 0.0
    }

    /// The mean flux of what hangs in the top level, W.
    pub(super) fn usual_flux(&self) -> f64 {
        let count = self.top.counts[self.top.number(self.top.root) as usize];
        f64::from(self.nodes[self.top.root as usize].merged().phi()) / f64::from(count.max(1))
    }

    /// After `leaves` were put in: those that outshine what is usual were put where they cost least in a tree that was built
    /// without them, which may be a bad one with them.
    pub(super) fn unsettle_bright(&mut self, leaves: &[u32], usual: f64) {
        self.epoch += u64::from(!leaves.is_empty());
        for &leaf in leaves {
            // Where the top level was built anew as it came in, it may have been opened or closed.
            if self.placed[leaf as usize].node == INVALID {
                continue;
            }
            let flux = f64::from(self.in_world(leaf).phi());
            if flux > BRIGHT * usual && usual > 0.0 {
                self.unsettle_above(self.placed[leaf as usize].node, flux);
            }
        }
    }

    /// Something below `node` and all above it has another flux, `flux` at most. What it outshines in a node is as good as
    /// unbuilt: that share of its instances, and no fewer than of the node below, for what is little among all may be much
    /// where it is. It counts as of the present epoch, so what is built from before it does not cover it.
    pub(super) fn unsettle_above(&mut self, node: u32, flux: f64) {
        let (mut node, mut affected) = (node, LEAST);
        while node != INVALID {
            let number = self.top.number(node) as usize;
            let all = f64::from(self.nodes[node as usize].merged().phi());
            let share = if all > flux { flux / all } else { 1.0 };
            affected = affected.max((share * f64::from(self.top.counts[number])) as u32);
            self.unsettle_one(number, affected);
            node = self.parents[node as usize];
        }
    }
}

#[cfg(all(test, feature = "std"))]
mod tests;
