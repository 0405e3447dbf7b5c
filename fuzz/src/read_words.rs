//! Files that hold any words.

use lightbvh::light::EmissiveTriangle;
use lightbvh::tree::Model;
use arbitrary::{Result, Unstructured};
use lightbvh::{Bvh, CompactNode, Edit, Eq4, ImportanceModel, MomentNode, Moments, Transform};

use crate::{Forms, input};

/// What a light BVH wrote, with words of it changed, cut or appended: it is refused, or read as a light BVH that is valid, is
/// written and read alike, samples with its pmf, and takes edits, refits and rebuilds.
pub fn read_words(data: &[u8], forms: Forms) {
    for form in forms.of(data, 3) {
        let u = &mut Unstructured::new(data);
        let _ = match form {
            0 => run::<(CompactNode<2>, Eq4), 2>(u),
            1 => run::<(CompactNode<4>, Eq4), 4>(u),
            _ => run::<(MomentNode<8>, Moments), 8>(u),
        };
    }
}

fn run<M: Model<W, Light = EmissiveTriangle>, const W: usize>(u: &mut Unstructured<'_>) -> Result<()>
where
    M::Importance: ImportanceModel<M::Node, W>,
{
    let params = input::params(u)?;
    let lights = input::lights(u)?;
    let bits: u8 = u.arbitrary()?;
    let mut written = match bits & 3 {
        0 => Bvh::<M, W>::single_level(&lights, &params),
        _ => Bvh::two_level(&lights, &params),
    };
    if bits & 4 != 0
        && let Some(instance) = written.view().instance_id(u.arbitrary::<u8>()?.into())
    {
        // A single level refuses it.
        let _ = written.apply(vec![Edit::RemoveInstance(instance)]);
    }
    if bits & 8 != 0 {
        written.refit();
    }
    let mut words = written.to_words();
    for _ in 0..u.int_in_range(0..=4)? {
        let at = usize::from(u.arbitrary::<u16>()?) % words.len();
        words[at] = match u.arbitrary::<u8>()? & 3 {
            0 => words[at] ^ (1 << (u.arbitrary::<u8>()? & 31)),
            1 => u32::from(u.arbitrary::<u8>()?),
            2 => words[usize::from(u.arbitrary::<u16>()?) % words.len()],
            _ => u.arbitrary()?,
        };
    }
    if bits & 16 != 0 {
        words.resize(usize::from(u.arbitrary::<u8>()?), u.arbitrary()?);
    }
    // As long as it says, or nothing else would be looked at.
    let length = words.len() as u32;
    if let Some(own) = words.get_mut(2) {
        *own = length;
    }
    let point = input::point(u, lights.all())?;
    let Ok(mut bvh) = Bvh::<M, W>::from_words(&words) else {
        return Ok(());
    };
    let again = bvh.to_words();
    let copy = Bvh::<M, W>::from_words(&again).unwrap_or_else(|error| panic!("{error}"));
    assert!(copy.to_words() == again);
    let random: u32 = u.arbitrary()?;
    for i in 0..3 {
        let sampled = bvh.tree().sample(&point, random.wrapping_add(i));
        let pmf = copy.tree().pmf(&point, sampled.light, sampled.instance);
        assert_eq!(pmf.to_bits(), sampled.pmf.to_bits());
    }
    let mesh = bvh.view().mesh_ids().next();
    if let Some(mesh) = mesh {
        // Refused where it is a single level, or there is no room.
        let _ = bvh.add_instance(mesh, Transform::IDENTITY);
    }
    bvh.refit();
    bvh.view().validate().expect("valid");
    bvh.rebuild();
    bvh.view().validate().expect("valid");
    Ok(())
}
