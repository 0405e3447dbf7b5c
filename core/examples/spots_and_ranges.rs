//! Variance and wasted samples of spots and of lights with ranges, by enumeration of all lights at many points.
//!
//! `cargo run --release -p lightbvh --example spots_and_ranges` (minutes). The variance is that of one sample, relative to what all
//! lights send, without shadows: Σ f²/p / (Σ f)² − 1. A sample is wasted if its light sends nothing to the point.

#![allow(clippy::disallowed_methods, reason = "nothing here is shared with devices")]

use std::collections::HashMap;

use lightbvh::exact::{hash, unit_f32};
use lightbvh::importance::LinkedPoint;
use lightbvh::light::{AnyLight, Light, PointLight, RectangleLight, SphereLight, SpotLight};
use lightbvh::tree::{AnyKind, Masked, Model, ReceiverOf};
use lightbvh::{AnyLights, Bvh, InstanceId, ShadingPoint, Transform};

type Error = Box<dyn std::error::Error>;

fn main() -> Result<(), Error> {
    println!("mean and median of relative variance, samples wasted");
    for origin in [0.0, 10_000.0] {
        for seed in 1..=3 {
            let scene = field(seed, origin);
            report(
                &format!("field at {origin} m, seed {seed}"),
                &[
                    ("AnyLights", scene.loose::<AnyKind, _>(|point| point)?),
                    ("MaskedLights", scene.loose::<Masked, _>(unmasked)?),
                ],
            );
        }
        for seed in 1..=3 {
            let scene = town(seed, 100, origin, true);
            report(
                &format!("town with ranges at {origin} m, seed {seed}"),
                &[("AnyLights", scene.as_given()?)],
            );
        }
    }
    for ends in [true, false] {
        let ranges = if ends { "ranges" } else { "no ranges" };
        for (cars, seed) in [(100, 1), (400, 1), (400, 2), (400, 3), (1600, 1)] {
            compare(
                &format!("{cars} cars, {ranges}, seed {seed}"),
                &cars_alone(seed, cars, ends),
            )?;
            compare(
                &format!("town, {cars} cars, {ranges}, seed {seed}"),
                &town(seed, cars, 0.0, ends),
            )?;
        }
    }
    Ok(())
}

/// A receiver that all lights may light.
fn unmasked(point: ShadingPoint) -> LinkedPoint<ShadingPoint> {
    let mask = u32::MAX;
    LinkedPoint { point, mask }
}

/// The default, each light by itself, and two light BVHs split by hand.
fn compare(name: &str, scene: &Scene) -> Result<(), Error> {
    let by_flux = scene.split(false)?;
    let halves = scene.split(true)?;
    report(
        name,
        &[
            ("AnyLights", scene.as_given()?),
            ("lights by themselves", scene.loose::<AnyKind, _>(|point| point)?),
            ("two by hand, by flux", by_flux),
            ("two by hand, halves", halves),
        ],
    );
    Ok(())
}

/// Random numbers.
struct Random(u32);

impl Random {
    fn unit(&mut self) -> f32 {
        self.0 = self.0.wrapping_add(1);
        unit_f32(hash(self.0))
    }

    fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.unit()
    }

    fn below(&mut self, end: u32) -> u32 {
        (self.unit() * end as f32) as u32
    }
}

/// Meshes of lights in one place each, and points on roads and walls.
#[derive(Default)]
struct Scene {
    meshes: Vec<Vec<AnyLight>>,
    /// Mesh and where it is.
    instances: Vec<(usize, Transform)>,
    points: Vec<ShadingPoint>,
}

/// Probabilities: at a point, of each light of [`Scene::world`].
type Pmfs<'a> = (
    Vec<AnyLight>,
    Box<dyn Fn(&ShadingPoint, usize) -> f64 + 'a>,
    &'a [ShadingPoint],
);

impl Scene {
    fn add(&mut self, mesh: Vec<AnyLight>, place: Transform) {
        self.meshes.push(mesh);
        self.instances.push((self.meshes.len() - 1, place));
    }

    /// All meshes as they are.
    fn as_given(&self) -> Result<Pmfs<'_>, Error> {
        let part = Part::of(self, |_| true)?;
        let lights = part.lights.clone();
        Ok((lights, Box::new(move |point, k| part.pmf(point, k)), &self.points))
    }

    /// Each light by itself, in a light BVH of model `M`.
    fn loose<M: Model<8, Light = AnyLight> + 'static, P: ReceiverOf<M, 8> + 'static>(
        &self,
        receiver: fn(ShadingPoint) -> P,
    ) -> Result<Pmfs<'_>, Error> {
        let mut bvh = Bvh::<M>::default();
        let world = Part::of(self, |_| true)?.lights;
        let ids = world
            .iter()
            .map(|light| bvh.add_light(*light))
            .collect::<Result<Vec<_>, _>>()?;
        bvh.refit();
        let pmf =
            move |point: &ShadingPoint, k: usize| bvh.pmf(&receiver(*point), ids[k], 0).unwrap_or(0.0).into();
        Ok((world, Box::new(pmf), &self.points))
    }

    /// Spots in one light BVH, all others in another; half of the samples to each, or in proportion to flux.
    fn split(&self, halves: bool) -> Result<Pmfs<'_>, Error> {
        let is_spot = |light: &AnyLight| SpotLight::try_from(*light).is_ok();
        let parts = [Part::of(self, is_spot)?, Part::of(self, |light| !is_spot(light))?];
        let flux = parts
            .each_ref()
            .map(|part| f64::from(part.bvh.view().summary().phi));
        let share = if halves {
            0.5
        } else {
            flux[0] / (flux[0] + flux[1])
        };
        let mut lights = parts[0].lights.clone();
        let spots = lights.len();
        lights.extend(&parts[1].lights);
        let pmf = move |point: &ShadingPoint, k: usize| match k < spots {
            true => share * parts[0].pmf(point, k),
            false => (1.0 - share) * parts[1].pmf(point, k - spots),
        };
        Ok((lights, Box::new(pmf), &self.points))
    }
}

/// A light BVH over some lights of a scene.
struct Part {
    bvh: AnyLights,
    lights: Vec<AnyLight>,
    /// Instance of each, and its place in the mesh.
    names: Vec<(InstanceId, u32)>,
}

impl Part {
    fn of(scene: &Scene, has: impl Fn(&AnyLight) -> bool) -> Result<Self, Error> {
        let mut bvh = AnyLights::default();
        let mut meshes = HashMap::new();
        for (k, own) in scene.meshes.iter().enumerate() {
            let own: Vec<AnyLight> = own.iter().copied().filter(|light| has(light)).collect();
            if !own.is_empty() {
                let count = own.len() as u32;
                meshes.insert(k, (bvh.add_mesh(own)?, count));
            }
        }
        let mut names = Vec::new();
        for (mesh, place) in &scene.instances {
            if let Some((mesh, count)) = meshes.get(mesh) {
                let id = bvh.add_instance(*mesh, *place)?;
                names.extend((0..*count).map(|part| (id, part)));
            }
        }
        bvh.refit();
        let light = |&(id, part): &(InstanceId, u32)| {
            let number = bvh.view().lights_of(id).map_or(0, |numbers| numbers.start) + part;
            bvh.view().light(number, id.index()).ok_or("a light")
        };
        let lights = names.iter().map(light).collect::<Result<_, _>>()?;
        Ok(Self { bvh, lights, names })
    }

    fn pmf(&self, point: &ShadingPoint, k: usize) -> f64 {
        let (id, part) = self.names[k];
        self.bvh.pmf(point, id, part).unwrap_or(0.0).into()
    }
}

fn report(name: &str, all: &[(&str, Pmfs<'_>)]) {
    println!("{name}");
    for (how, (lights, pmf, points)) in all {
        let (mut variances, mut wasted) = (Vec::new(), 0.0);
        for point in *points {
            let (mut sum, mut squares, mut dark) = (0.0, 0.0, 0.0);
            for (k, light) in lights.iter().enumerate() {
                let p = pmf(point, k);
                let irradiance = light.point_for(point.p.into(), [0.5; 2]).irradiance(point);
                let f = f64::from(irradiance[0] + irradiance[1] + irradiance[2]);
                sum += f;
                match f > 0.0 {
                    true => squares += f * f / p,
                    false => dark += p,
                }
            }
            if sum > 0.0 {
                variances.push(squares / (sum * sum) - 1.0);
                wasted += dark;
            }
        }
        variances.sort_by(f64::total_cmp);
        let count = variances.len() as f64;
        println!(
            "  {how:22} {:7.2} ({:.2}), {:4.1} %",
            variances.iter().sum::<f64>() / count,
            variances[variances.len() / 2],
            100.0 * wasted / count
        );
    }
}

fn bulb(p: [f32; 3], intensity: f32, range: f32) -> AnyLight {
    let intensity = [intensity; 3];
    PointLight {
        p,
        intensity,
        range,
        mesh: 0,
    }
    .into()
}

/// A spot with half its angle to full intensity.
fn spot(p: [f32; 3], axis: [f32; 3], angle: f32, intensity: f32, range: f32) -> AnyLight {
    let intensity = [intensity; 3];
    let spot = SpotLight {
        p,
        intensity,
        axis,
        range,
        ..SpotLight::DARK
    };
    let angle = angle.to_radians();
    spot.with_cone(0.5 * angle, angle).into()
}

/// 2,000 points and spots that end after 15 and 25 m, 3 to 6 m above a field of 200 m.
fn field(seed: u32, origin: f32) -> Scene {
    let (mut random, mut scene) = (Random(seed << 20), Scene::default());
    for k in 0..2000 {
        let p = [
            random.between(-100.0, 100.0),
            random.between(3.0, 6.0),
            random.between(-100.0, 100.0),
        ];
        let range = [15.0, 25.0][k % 2];
        let light = match k % 4 {
            0 | 1 => bulb([0.0; 3], 1.0, range),
            _ => spot([0.0; 3], [0.0, -1.0, 0.0], 50.0, 2.0, range),
        };
        scene.add(vec![light], Transform::at([p[0] + origin, p[1], p[2] + origin]));
    }
    scene.points = (0..1000)
        .map(|_| {
            floor(
                random.between(-100.0, 100.0) + origin,
                random.between(-100.0, 100.0) + origin,
            )
        })
        .collect();
    scene
}

fn floor(x: f32, z: f32) -> ShadingPoint {
    ShadingPoint {
        p: [x, 0.0, z],
        n: [0.0, 1.0, 0.0],
    }
}

/// Metres from one street to the next; streets in each of two directions.
const BLOCK: f32 = 80.0;
const STREETS: u32 = 5;
const LENGTH: f32 = BLOCK * STREETS as f32;

/// From a place along a street and one across it to the world; `turned` streets run along z.
fn place(turned: bool, street: u32, along: f32, across: f32, origin: f32) -> [f32; 2] {
    let across = (street as f32 + 0.5) * BLOCK + across;
    let [x, z] = if turned { [across, along] } else { [along, across] };
    [x + origin, z + origin]
}

/// Headlights and tail lights, forward is +z: 2,000 and 5 cd.
fn car(ends: bool) -> Vec<AnyLight> {
    let range = if ends { 60.0 } else { 0.0 };
    let down = 0.035_f32;
    let axis = [0.0, -down, (1.0 - down * down).sqrt()];
    let tail = |x| SphereLight {
        p: [x, 0.8, -2.2],
        radius: 0.05,
        radiance: [600.0, 10.0, 10.0],
        mesh: 0,
    };
    vec![
        spot([-0.7, 0.7, 2.2], axis, 30.0, 2000.0, range),
        spot([0.7, 0.7, 2.2], axis, 30.0, 2000.0, range),
        tail(-0.7).into(),
        tail(0.7).into(),
    ]
}

/// Cars on the streets in both directions, standing or driving, and points on roads and walls.
fn add_cars(scene: &mut Scene, random: &mut Random, cars: u32, origin: f32, ends: bool) {
    scene.meshes.push(car(ends));
    let mesh = scene.meshes.len() - 1;
    for _ in 0..cars {
        let (turned, street) = (random.below(2) == 1, random.below(STREETS));
        let (along, side) = (random.between(0.0, LENGTH), [-1.0, 1.0][random.below(2) as usize]);
        let [x, z] = place(turned, street, along, side * random.between(2.0, 4.0), origin);
        // Right hand traffic, a few degrees off the street.
        let angle = random.between(-0.05, 0.05) + if turned { 0.0 } else { std::f32::consts::FRAC_PI_2 };
        let (sin, cos) = (side * angle.sin(), side * angle.cos());
        let columns = [[cos, 0.0, -sin], [0.0, 1.0, 0.0], [sin, 0.0, cos]];
        scene.instances.push((
            mesh,
            Transform {
                columns,
                translation: [x, 0.0, z],
            },
        ));
    }
    for k in 0..600 {
        let (turned, street, along) = (
            random.below(2) == 1,
            random.below(STREETS),
            random.between(0.0, LENGTH),
        );
        scene.points.push(if k % 3 == 0 {
            let side = [-1.0, 1.0][random.below(2) as usize];
            let [x, z] = place(turned, street, along, side * 9.0, origin);
            let n = if turned {
                [-side, 0.0, 0.0]
            } else {
                [0.0, 0.0, -side]
            };
            ShadingPoint {
                p: [x, random.between(0.0, 12.0), z],
                n,
            }
        } else {
            let [x, z] = place(turned, street, along, random.between(-8.0, 8.0), origin);
            floor(x, z)
        });
    }
}

fn cars_alone(seed: u32, cars: u32, ends: bool) -> Scene {
    let (mut random, mut scene) = (Random(seed << 20), Scene::default());
    add_cars(&mut scene, &mut random, cars, 0.0, ends);
    scene
}

/// Streets with lamps, windows and cars.
fn town(seed: u32, cars: u32, origin: f32, ends: bool) -> Scene {
    let (mut random, mut scene) = (Random(seed << 20), Scene::default());
    for turned in [false, true] {
        for street in 0..STREETS {
            let range = if ends { 25.0 } else { 0.0 };
            // Lamps each 9 m, on both sides: half of them bulbs, the others shine down.
            for k in 0..2 * (LENGTH / 9.0) as u32 {
                let side = [-6.0, 6.0][k as usize % 2];
                let [x, z] = place(turned, street, 4.5 * k as f32, side, origin);
                let lamp = match k % 4 {
                    0 | 1 => bulb([0.0; 3], 200.0, range),
                    _ => spot([0.0; 3], [0.0, -1.0, 0.0], 65.0, 400.0, range),
                };
                scene.add(vec![lamp], Transform::at([x, 6.0, z]));
            }
            for _ in 0..500 / (2 * STREETS) {
                let side = [-1.0, 1.0][random.below(2) as usize];
                let [x, z] = place(turned, street, random.between(0.0, LENGTH), side * 9.0, origin);
                let half = match turned {
                    true => [[0.0, 0.0, 0.5 * side], [0.0, 0.7, 0.0]],
                    false => [[0.5 * -side, 0.0, 0.0], [0.0, 0.7, 0.0]],
                };
                let radiance = [random.between(2.0, 20.0); 3];
                let window = RectangleLight {
                    p: [0.0; 3],
                    half,
                    radiance,
                    mesh: 0,
                    flags: 0,
                };
                scene.add(
                    vec![window.into()],
                    Transform::at([x, random.between(2.0, 12.0), z]),
                );
            }
        }
    }
    add_cars(&mut scene, &mut random, cars, origin, ends);
    scene
}
