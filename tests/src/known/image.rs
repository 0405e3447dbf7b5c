//! Answers of the renderer: an image by lights sampled from a tree, by the kernel's function or by the kernel.

use bytemuck::bytes_of;
use glam::UVec3;
use lightbvh::TreeWords;
use lightbvh_host::vulkan::{Device, Pass};
use lightbvh_kernels::render::{RenderParams, RenderPush, render_bvh};

use super::file::{Answer, File};

fn push(file: &File) -> RenderPush {
    let params: RenderParams = file.records("params")[0];
    let tree: TreeWords = file.records("tree")[0];
    RenderPush {
        params,
        first: 0,
        count: params.width * params.height,
        tree,
    }
}

/// The answers of the CPU.
#[must_use]
pub fn answer(file: &File) -> Vec<Answer> {
    let push = push(file);
    let (ray_nodes, surfaces) = (file.records("ray_nodes"), file.records("surfaces"));
    let (materials, triangles) = (file.records("materials"), file.records("triangles"));
    let (camera, nodes) = (file.records("camera"), file.records("nodes"));
    let (instances, trails) = (file.records("instances"), file.records::<u32>("trails"));
    let mut pixels = vec![[0.0; 3]; push.count as usize];
    for i in 0..push.count {
        render_bvh(
            UVec3::new(i, 0, 0),
            &push,
            &ray_nodes,
            &surfaces,
            &materials,
            &triangles,
            &instances,
            &camera,
            &nodes,
            &trails,
            &mut pixels,
        );
    }
    vec![Answer::new("pixels", &pixels)]
}

/// The answers of a device.
///
/// # Panics
/// If the device fails.
#[must_use]
pub fn answer_on(device: &Device, file: &File) -> Vec<Answer> {
    use lightbvh::{EmissiveTriangle, Instance};
    use lightbvh_kernels::bvh::Node;
    use lightbvh_kernels::shading::camera::Camera;
    use lightbvh_kernels::shading::material::Material;
    use lightbvh_kernels::shading::trace::{RayNode, TriangleBlock};

    fn upload<T: bytemuck::Pod>(
        device: &Device,
        file: &File,
        table: &str,
    ) -> lightbvh_host::vulkan::Buffer<T> {
        device.upload(&file.records::<T>(table)).expect("an upload")
    }
    let push = push(file);
    let ray_nodes = upload::<RayNode>(device, file, "ray_nodes");
    let surfaces = upload::<TriangleBlock>(device, file, "surfaces");
    let materials = upload::<Material>(device, file, "materials");
    let triangles = upload::<EmissiveTriangle>(device, file, "triangles");
    let camera = upload::<Camera>(device, file, "camera");
    let nodes = upload::<Node>(device, file, "nodes");
    let instances = upload::<Instance>(device, file, "instances");
    let trails = upload::<u32>(device, file, "trails");
    let pixels = device.output::<[f32; 3]>(push.count as usize).expect("an output");
    let bindings = [
        ray_nodes.bind(),
        surfaces.bind(),
        materials.bind(),
        triangles.bind(),
        instances.bind(),
        camera.bind(),
        nodes.bind(),
        trails.bind(),
        pixels.bind(),
    ];
    let kernel = device.kernel("render_bvh").expect("a kernel");
    let mut pass = Pass::new();
    pass.dispatch(&kernel, &bindings, bytes_of(&push), push.count);
    device.run(&pass).expect("a run");
    vec![Answer::new("pixels", &pixels.read().expect("a read"))]
}
