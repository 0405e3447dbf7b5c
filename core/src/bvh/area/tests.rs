//! Flux of instances in the top level against the flux of their lights where they stand in the world, for each kind of light.

extern crate std;

use crate::model::Model;
use std::vec::Vec;

use crate::bvh::{Bvh, Edit};
use crate::importance::{Defensive, Eq4, Moments};
use crate::instance::Instance;
use crate::kit::lights::{SHINE, disc, rectangle, sphere, spot};
use crate::kit::{self, Random};
use crate::light::{
    AnyLight, DiscLight, EmissiveTriangle, Light, PointLight, RectangleLight, SphereLight, SpotLight,
};
use crate::node::{CompactNode, MomentNode, Node};
use crate::summary::Summary;
use crate::transform::Transform;

type Tree<L> = Bvh<(MomentNode<8, L>, Defensive<Moments, 6>)>;
type BoundsTree<L> = Bvh<(CompactNode<4, L>, Eq4), 4>;

const PER_MESH: usize = 5;

fn at(random: &mut Random) -> [f32; 3] {
    random.vector().to_array()
}

fn point(random: &mut Random) -> PointLight {
    PointLight {
        p: at(random),
        intensity: SHINE,
        range: 0.0,
        mesh: 0,
    }
}

fn triangle(random: &mut Random) -> EmissiveTriangle {
    let [x, y, z] = at(random);
    kit::triangle([[x, y, z], [x + 1.0, y, z + 0.25], [x, y + 0.5, z - 0.125]])
}

fn diagonal(x: f32, y: f32, z: f32) -> Transform {
    Transform {
        columns: [[x, 0.0, 0.0], [0.0, y, 0.0], [0.0, 0.0, z]],
        translation: [3.0, -2.0, 1.0],
    }
}

/// Even scales, a mirror, stretches along axes, and a shear.
fn maps() -> [Transform; 6] {
    let shear = Transform {
        columns: [[1.0, 0.5, 0.0], [0.0, 0.75, 0.25], [0.5, 0.0, 1.25]],
        ..Transform::IDENTITY
    };
    [
        Transform::IDENTITY,
        diagonal(3.0, 3.0, 3.0),
        diagonal(0.125, -0.125, 0.125),
        diagonal(2.0, 1.0, 1.0),
        diagonal(0.75, 1.0, 1.5),
        shear,
    ]
}

/// Flux of all lights of an instance, each in the world.
fn apart<L: Light>(lights: &[L], instance: &Instance) -> f64 {
    let of = |light: &L| f64::from(light.in_world(instance, 0).moments().phi);
    lights.iter().map(of).sum()
}

/// What an instance makes of its mesh's flux, as the top level takes it, is what it makes of the lights'. Nodes keep the mesh's
/// coarsely.
fn agrees<M: Model<W>, const W: usize>(name: &str, bvh: &Bvh<M, W>, index: usize, lights: &[M::Light]) {
    let instance = &bvh.instances[index];
    let own = f64::from(
        bvh.roots[instance.blas as usize]
            .summary::<<M::Node as Node<W>>::Summary>()
            .phi(),
    );
    let found = f64::from(bvh.leaf_of(index as u32).summary.phi()) / own;
    let expected = apart(lights, instance) / apart(lights, &Instance::IDENTITY);
    assert!(
        // How a map stretches surfaces goes by their mean normal, which nodes keep coarsely.
        (found / expected - 1.0).abs() < if lights[0].is_surface() { 4e-3 } else { 1e-4 },
        "{name}, {:?}: {found:e}, expected {expected:e}",
        instance.columns
    );
    assert_eq!(bvh.view().validate().map(|_| ()), Ok(()), "{name}");
}

/// A mesh under each map, at half its radiance; then the share of all flux that the root gives to each.
fn check<L: Light>(mut make: impl FnMut(&mut Random) -> L) {
    let random = &mut Random(11);
    let lights: Vec<L> = (0..PER_MESH).map(|_| make(random)).collect();
    let mut bvh = Tree::<L>::default();
    let mut bounds = BoundsTree::<L>::default();
    let mesh = bvh.add_mesh(lights.clone()).expect("in the domain");
    let of_bounds = bounds.add_mesh(lights.clone()).expect("in the domain");
    for map in maps() {
        let id = bvh.add_instance(mesh, map).expect("in the domain");
        bvh.set_radiance(id, [0.5; 3]).expect("a factor");
        let id = bounds.add_instance(of_bounds, map).expect("in the domain");
        bounds.set_radiance(id, [0.5; 3]).expect("a factor");
    }
    bvh.refit();
    bounds.refit();
    for (index, _) in maps().iter().enumerate() {
        agrees(L::NAME, &bvh, index, &lights);
        // A cone says nothing of how a map stretches surfaces that face one way.
        if index < 3 || !lights[0].is_surface() {
            agrees(L::NAME, &bounds, index, &lights);
        }
    }
    let all: f64 = bvh.instances[..maps().len()]
        .iter()
        .map(|i| apart(&lights, i))
        .sum();
    let found = f64::from(bvh.view().summary().phi());
    assert!(
        // Nodes of both levels keep flux to 1/16: half of that each.
        (found / all - 1.0).abs() < 0.064,
        "{}: {found:e}, {all:e}",
        L::NAME
    );
}

/// As its own type, and as [`AnyLight`].
fn check_both<L: Light + Into<AnyLight>>(make: fn(&mut Random) -> L) {
    check(make);
    check(|random| make(random).into());
}

#[test]
fn flux_of_lights_without_size_is_that_of_the_mesh() {
    check_both(point);
    // All along one axis, so that their mean normal is long.
    check_both(|random| SpotLight {
        p: at(random),
        ..spot(0.9, 0.5)
    });
}

#[test]
fn flux_of_surfaces_grows_with_area() {
    check_both(|random| SphereLight {
        p: at(random),
        ..sphere()
    });
    check_both(|random| RectangleLight {
        p: at(random),
        ..rectangle(0)
    });
    check_both(|random| DiscLight {
        p: at(random),
        ..disc(0)
    });
    check_both(triangle);
}

/// Edits that change the kind of a mesh's lights, all at once and one by one: instances know, and a mesh of several kinds goes
/// by area.
#[test]
fn edits_change_how_flux_grows() {
    let random = &mut Random(5);
    let points: Vec<AnyLight> = (0..PER_MESH).map(|_| point(random).into()).collect();
    let spheres = std::vec![AnyLight::from(sphere()); PER_MESH];
    let mut bvh = Tree::<AnyLight>::default();
    let mesh = bvh.add_mesh(points.clone()).expect("in the domain");
    let other = bvh.add_mesh(spheres.clone()).expect("in the domain");
    for mesh in [mesh, mesh, other] {
        bvh.add_instance(mesh, diagonal(2.0, 2.0, 2.0))
            .expect("in the domain");
    }
    bvh.refit();
    let flux = |bvh: &Tree<AnyLight>| [0, 1, 2].map(|index: usize| bvh.instances[index].flux);
    assert_eq!(flux(&bvh), [1.0, 1.0, 4.0]);
    for (from, own, name) in [(&spheres, 4.0, "spheres"), (&points, 1.0, "points")] {
        for (k, &light) in from.iter().enumerate() {
            let (first, lights) = (k as u32, std::vec![light]);
            bvh.apply(std::vec![Edit::SetLightRange { mesh, first, lights }])
                .expect("a light");
            bvh.refit();
            let own = if k + 1 < PER_MESH { 4.0 } else { own };
            assert_eq!(flux(&bvh), [own, own, 4.0], "{name} {k}");
            assert_eq!(bvh.view().validate().map(|_| ()), Ok(()));
        }
        agrees(name, &bvh, 1, from);
        let again = Tree::<AnyLight>::from_words(&bvh.to_words()).expect("written by itself");
        assert_eq!(again.instances, bvh.instances);
    }
    let lights = spheres.clone();
    bvh.apply(std::vec![Edit::SetLights { mesh, lights }])
        .expect("as many");
    bvh.refit();
    agrees("spheres at once", &bvh, 1, &spheres);
}
