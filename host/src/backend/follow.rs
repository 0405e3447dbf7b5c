//! A BVH and its edits on a device: what changed is copied, the rest is computed there, all in one submission with what is
//! asked next.

use std::time::Duration;

use bytemuck::{Pod, bytes_of, cast_slice};
use lightbvh::node::Node;
use lightbvh_gpu::{Buffer as Array, Frame, Mirror, Refit};
use lightbvh_kernels::bvh::Choice;

use super::device::DeviceBackend;
use super::device_arrays::device_time;
use super::{BackendError, Bvh, Follow, Timed};
use crate::scene::SceneLight;
use crate::vulkan::{Buffer, Device, Pass, Submission, VulkanError};

/// Bytes of a frame that are kept for the submission of what is asked next; more are submitted at once, from where they lie.
const KEPT: usize = 1 << 20;

impl<C: Choice<W, Light: SceneLight>, const W: usize> Follow<C, W> for DeviceBackend<'_, C, W> {
    fn follow(&mut self, bvh: &Bvh<C, W>) -> Result<Timed<()>, BackendError> {
        let submitted = match self.stage(bvh)? {
            Some(submitted) => Some(submitted),
            None => self.flush()?,
        };
        let time = match submitted {
            Some(submitted) => device_time(&submitted.wait()?),
            None => Duration::ZERO,
        };
        Ok(Timed { time, value: () })
    }
}

impl<C: Choice<W>, const W: usize> DeviceBackend<'_, C, W> {
    /// [`follow`](Follow::follow) without a wait: copies and refit go with the submission of what is asked next, or of
    /// [`flush`](Self::flush). Where more than 1 MiB is copied they are submitted at once.
    ///
    /// Nothing of `bvh` depends on what becomes of the device. What fails here is copied as a whole the next time; where the
    /// device is lost, another one takes over by [`new`](Self::new).
    ///
    /// # Errors
    /// [`BackendError`] from a device.
    pub fn follow_ahead(&mut self, bvh: &Bvh<C, W>) -> Result<(), BackendError> {
        self.stage(bvh).map(drop)
    }

    /// Submits what was followed and is not yet; waits for nothing.
    ///
    /// # Errors
    /// [`BackendError`] from a device.
    pub fn flush(&mut self) -> Result<Option<Submission>, BackendError> {
        match &self.pending {
            None => Ok(None),
            Some(pending) => {
                let submitted = self.device.submit(pending)?;
                self.pending = None;
                Ok(Some(submitted))
            }
        }
    }

    /// A pass that begins with what was followed and is not yet submitted.
    pub(super) fn led<'a>(&self) -> Pass<'a> {
        self.pending.clone().unwrap_or_default()
    }

    /// Submits a pass that [`led`](Self::led) has begun.
    pub(super) fn submit(&mut self, pass: &Pass<'_>) -> Result<Submission, BackendError> {
        let submitted = self.device.submit(pass)?;
        self.pending = None;
        Ok(submitted)
    }

    /// Makes the frame's work the pending one, or submits it.
    fn stage(&mut self, bvh: &Bvh<C, W>) -> Result<Option<Submission>, BackendError> {
        self.flush()?;
        let frame = self.mirror.frame(bvh);
        let staged = self.stage_frame(bvh, &frame);
        if staged.is_err() {
            // The mirror believes that the frame was followed.
            self.mirror = Mirror::default();
        }
        staged
    }

    fn stage_frame(&mut self, bvh: &Bvh<C, W>, frame: &Frame) -> Result<Option<Submission>, BackendError> {
        let mut pass = Pass::new();
        self.copy_changes(bvh, frame, &mut pass)?;
        self.refit_by(&frame.refit, &mut pass)?;
        if pass.bytes() > KEPT {
            return Ok(Some(self.device.submit(&pass)?));
        }
        self.pending = (!pass.is_empty()).then(|| pass.into_owned());
        Ok(None)
    }

    /// Appends the dispatches of a refit.
    pub(super) fn refit_by<'a>(&mut self, refit: &'a Refit, pass: &mut Pass<'a>) -> Result<(), BackendError> {
        if refit.dispatches.is_empty() {
            return Ok(());
        }
        if !self.list.set_len(refit.list.len()) {
            self.list = self.device.buffer(refit.list.len(), roomy(refit.list.len()))?;
        }
        pass.write(&self.list, 0, &refit.list)?;
        let children = refit.children as usize / size_of::<u32>();
        if !self.children.set_len(children.max(self.children.len())) {
            self.children = self.device.buffer(children, roomy(children))?;
        }
        for dispatch in &refit.dispatches {
            let kernel = self.kernel(dispatch.pass.name())?;
            let buffers = self.buffers(&kernel);
            pass.dispatch(&kernel, &buffers, bytes_of(&dispatch.push()), dispatch.count);
        }
        Ok(())
    }

    /// Makes the device's arrays those of `bvh`, but for the summaries that are refitted.
    pub(super) fn copy_changes<'a>(
        &mut self,
        bvh: &'a Bvh<C, W>,
        frame: &Frame,
        pass: &mut Pass<'a>,
    ) -> Result<(), BackendError> {
        let (device, own) = (self.device, &mut self.tree);
        renew(device, &mut own.nodes, bvh, frame, Array::Nodes, pass)?;
        renew(device, &mut own.instances, bvh, frame, Array::Instances, pass)?;
        renew(device, &mut own.trails, bvh, frame, Array::Trails, pass)?;
        renew(device, &mut self.roots, bvh, frame, Array::Roots, pass)?;
        renew(device, &mut own.triangles, bvh, frame, Array::Triangles, pass)?;
        let top = self.mirror.top::<C::Node>() as usize;
        own.bottoms = bvh.nodes().len();
        own.top = top..top + bvh.top_nodes().len();
        own.push = frame.words;
        Ok(())
    }
}

/// Does a frame's copies of one buffer. If it needs more capacity, another buffer replaces it; the device copies the rest.
fn renew<'a, T: Pod, N: Node<W>, I, const W: usize>(
    device: &Device,
    buffer: &mut Buffer<T>,
    bvh: &'a lightbvh::Bvh<N, I, W>,
    frame: &Frame,
    array: Array,
    pass: &mut Pass<'a>,
) -> Result<(), VulkanError> {
    let copies = || frame.copies.iter().filter(|copy| copy.buffer == array);
    let resized = frame.resizes.iter().find(|(resized, _)| *resized == array);
    let len = resized.map_or(buffer.len(), |(_, bytes)| *bytes as usize / size_of::<T>());
    if len == buffer.len() && copies().next().is_none() {
        return Ok(());
    }
    if !buffer.set_len(len) {
        let new = device.buffer(len, roomy(len))?;
        pass.carry(buffer, &new);
        *buffer = new;
    }
    for copy in copies() {
        let first = copy.bytes.start as usize / size_of::<T>();
        pass.write(buffer, first, cast_slice(copy.source(bvh)))?;
    }
    Ok(())
}

/// Room for `len` elements and half as many again: most frames then need no new buffer.
pub(super) fn roomy(len: usize) -> usize {
    len + len / 2
}
