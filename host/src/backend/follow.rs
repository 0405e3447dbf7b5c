//! A BVH and its edits on a device: what changed is copied, the rest is computed there, all in one submission with what is
//! asked next.

use std::sync::Arc;
use std::time::Duration;

use bytemuck::{Pod, bytes_of};
use lightbvh::TreeWords;
use lightbvh_gpu::{Buffer as Array, Copy, Frame, Mirror, Refit};
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

    /// Lists a refit of everything anew, for [`Backend::refit`](super::Backend::refit) after edits: of what was followed last.
    pub fn list_everything(&mut self, bvh: &Bvh<C, W>) {
        self.refit = Some(Refit::new::<C::Node, W>(&bvh.plan_of_everything()));
        self.counts = bvh.mesh_counts();
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
        let frame = self.mirror.follow(bvh);
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
        let is_rewired = |copy: &Copy| matches!(copy.buffer, Array::Nodes | Array::Trails);
        if !frame.resizes.is_empty() || frame.copies.iter().any(is_rewired) {
            // Listing everything takes as long as everything is large, which no frame waits for.
            self.refit = None;
        }
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
    fn copy_changes<'a>(
        &mut self,
        bvh: &'a Bvh<C, W>,
        frame: &Frame,
        pass: &mut Pass<'a>,
    ) -> Result<(), BackendError> {
        let (device, tree, own) = (self.device, bvh.tree(), &mut self.tree);
        let emitters = &mut own.emitters;
        renew(device, &mut own.nodes, tree.nodes, frame, Array::Nodes, pass)?;
        renew(
            device,
            &mut emitters.instances,
            tree.instances,
            frame,
            Array::Instances,
            pass,
        )?;
        renew(device, &mut own.trails, tree.trails, frame, Array::Trails, pass)?;
        renew(device, &mut self.roots, bvh.roots(), frame, Array::Roots, pass)?;
        renew(
            device,
            &mut emitters.triangles,
            bvh.triangles(),
            frame,
            Array::Triangles,
            pass,
        )?;
        self.tree.push = TreeWords::of(&tree);
        Ok(())
    }
}

/// Does a frame's copies of one array. Another buffer takes its place where it needs more room, or where something else reads
/// it as it is; what stays is carried over by the device.
fn renew<'a, T: Pod>(
    device: &Device,
    buffer: &mut Arc<Buffer<T>>,
    data: &'a [T],
    frame: &Frame,
    array: Array,
    pass: &mut Pass<'a>,
) -> Result<(), VulkanError> {
    let copies = || frame.copies.iter().filter(|copy| copy.buffer == array);
    let is_resized = buffer.len() != data.len();
    if !is_resized && copies().next().is_none() {
        return Ok(());
    }
    if !Arc::get_mut(buffer).is_some_and(|own| own.set_len(data.len())) {
        let room = if data.len() > buffer.room() {
            roomy(data.len())
        } else {
            buffer.room()
        };
        let new = device.buffer(data.len(), room)?;
        pass.carry(buffer, &new);
        *buffer = Arc::new(new);
    }
    for copy in copies() {
        let element = |byte: u64| byte as usize / size_of::<T>();
        let first = element(copy.bytes.start);
        pass.write(buffer, first, &data[first..element(copy.bytes.end)])?;
    }
    Ok(())
}

/// Room for `len` elements and half as many again: most frames then need no new buffer.
pub(super) fn roomy(len: usize) -> usize {
    len + len / 2
}
