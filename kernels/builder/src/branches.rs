//! The shape of branches: an `if` without `else` has one arm.
//!
//! rust-gpu writes every selection as two blocks that meet in a third, though most have nothing to do in one of the two.
//! Where both ways to a meeting point are equally long, `SwiftShader` does not finish: to tell a loop's back edge from its
//! entry it searches the loop's body breadth first, and marks a block when it is taken from the queue, not when it is put
//! there (`Spirv::Function::ExistsPath` of its `SpirvShaderControlFlow.cpp`). Each such meeting point is queued
//! twice for every time that its selection is, so a body with thirty of them in a row is searched along 2^30 ways, in as
//! much memory. With a direct edge the meeting point is marked before the longer way arrives.
//!
//! Nothing that is computed changes, and other drivers drop empty blocks themselves.

use rspirv::dr::{Block, Function, Instruction, Module, Operand};
use rspirv::spirv::Op;
use std::collections::{HashMap, HashSet};

/// Takes empty arms out of all selections of `module`: the branch goes to where the arms meet. Of two empty arms one
/// stays.
pub(crate) fn drop_empty_arms(module: &mut Module) {
    for function in &mut module.functions {
        drop_in(function);
    }
}

fn drop_in(function: &mut Function) {
    let empty = empty_blocks(function);
    let mut gone = HashSet::new();
    // Arm to be dropped and the header that now leads to where it led, by that block.
    let mut moved: HashMap<u32, Vec<(u32, u32)>> = HashMap::new();
    for block in &mut function.blocks {
        let header = label(block);
        let [.., merge, branch] = block.instructions.as_mut_slice() else {
            continue;
        };
        if merge.class.opcode != Op::SelectionMerge || branch.class.opcode != Op::BranchConditional {
            continue;
        }
        let (Some(meeting), Some(yes), Some(no)) = (id_at(merge, 0), id_at(branch, 1), id_at(branch, 2))
        else {
            continue;
        };
        if yes == no || yes == meeting || no == meeting {
            continue;
        }
        for (at, arm) in [(2, no), (1, yes)] {
            if empty.get(&arm) == Some(&meeting) {
                branch.operands[at] = Operand::IdRef(meeting);
                gone.insert(arm);
                moved.entry(meeting).or_default().push((arm, header));
                break;
            }
        }
    }
    function.blocks.retain(|block| !gone.contains(&label(block)));
    for block in &mut function.blocks {
        for (arm, header) in moved.remove(&label(block)).unwrap_or_default() {
            come_from(block, arm, header);
        }
    }
}

/// The blocks that only branch on, are branched to from one place and are no block that a merge instruction names; with
/// the block they branch to.
fn empty_blocks(function: &Function) -> HashMap<u32, u32> {
    let mut entries: HashMap<u32, usize> = HashMap::new();
    let mut named = HashSet::new();
    for inst in function.blocks.iter().flat_map(|block| &block.instructions) {
        let merges = matches!(inst.class.opcode, Op::SelectionMerge | Op::LoopMerge);
        let branches = matches!(inst.class.opcode, Op::Branch | Op::BranchConditional | Op::Switch);
        for operand in &inst.operands {
            match operand {
                Operand::IdRef(id) if merges => {
                    named.insert(*id);
                }
                Operand::IdRef(id) if branches => *entries.entry(*id).or_default() += 1,
                _ => {}
            }
        }
    }
    function
        .blocks
        .iter()
        .filter_map(|block| match block.instructions.as_slice() {
            [only] if only.class.opcode == Op::Branch => Some((label(block), id_at(only, 0)?)),
            _ => None,
        })
        .filter(|(block, _)| entries.get(block) == Some(&1) && !named.contains(block))
        .collect()
}

/// Values that come to `block` from the block `old` come from `new`.
fn come_from(block: &mut Block, old: u32, new: u32) {
    let phis = block
        .instructions
        .iter_mut()
        .take_while(|inst| inst.class.opcode == Op::Phi);
    // Operands are pairs of a value and the block it comes from.
    for from in phis.flat_map(|phi| phi.operands.iter_mut().skip(1).step_by(2)) {
        if *from == Operand::IdRef(old) {
            *from = Operand::IdRef(new);
        }
    }
}

/// The block's id; 0, which is no id, where it has none.
pub(crate) fn label(block: &Block) -> u32 {
    block
        .label
        .as_ref()
        .and_then(|label| label.result_id)
        .unwrap_or(0)
}

pub(crate) fn id_at(inst: &Instruction, at: usize) -> Option<u32> {
    match inst.operands.get(at) {
        Some(Operand::IdRef(id)) => Some(*id),
        _ => None,
    }
}
