//! The buffers' names: those of the kernels' parameters, which the compiler's debug information holds.

use std::collections::{BTreeMap, HashMap};

use rspirv::dr::Operand;
use rspirv::spirv::{Decoration, Op};

use crate::{Error, load};

/// The names of each entry point's buffers, by binding, from a module that has its debug names still. An entry point's list ends
/// before the first binding without a name.
///
/// # Errors
/// When the words are not a SPIR-V module.
pub fn buffer_names(words: &[u32]) -> Result<BTreeMap<String, Vec<String>>, Error> {
    let module = load(words)?;
    let names: HashMap<u32, &String> = module
        .debug_names
        .iter()
        .filter_map(|inst| match inst.operands.as_slice() {
            [Operand::IdRef(id), Operand::LiteralString(name)] if inst.class.opcode == Op::Name => {
                Some((*id, name))
            }
            _ => None,
        })
        .collect();
    let bindings: HashMap<u32, u32> = module
        .annotations
        .iter()
        .filter_map(|inst| match inst.operands.as_slice() {
            [
                Operand::IdRef(id),
                Operand::Decoration(Decoration::Binding),
                Operand::LiteralBit32(binding),
            ] => Some((*id, *binding)),
            _ => None,
        })
        .collect();
    let mut all = BTreeMap::new();
    for entry in &module.entry_points {
        let mut found = BTreeMap::new();
        let mut entry_point = String::new();
        for operand in &entry.operands {
            match operand {
                Operand::LiteralString(name) => entry_point.clone_from(name),
                Operand::IdRef(id) => {
                    if let (Some(binding), Some(&name)) = (bindings.get(id), names.get(id)) {
                        found.insert(*binding, name.clone());
                    }
                }
                _ => {}
            }
        }
        let in_order = (0..)
            .zip(found)
            .take_while(|(expected, (binding, _))| expected == binding);
        all.insert(entry_point, in_order.map(|(_, (_, name))| name).collect());
    }
    Ok(all)
}
