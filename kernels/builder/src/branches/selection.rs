//! Two-way branches, and the blocks around them.

use rspirv::dr::{Block, Function, Instruction, Operand};
use rspirv::spirv::{Op, SelectionControl};
use std::collections::{HashMap, HashSet};

/// A two-way branch at the end of a block, with the block where its arms meet.
#[derive(Clone, Copy)]
pub(super) struct Selection {
    pub condition: u32,
    pub yes: u32,
    pub no: u32,
    pub merge: u32,
}

impl Selection {
    pub fn of(block: &Block) -> Option<Self> {
        let [.., merge, branch] = block.instructions.as_slice() else {
            return None;
        };
        if merge.class.opcode != Op::SelectionMerge || branch.class.opcode != Op::BranchConditional {
            return None;
        }
        let [
            Operand::IdRef(condition),
            Operand::IdRef(yes),
            Operand::IdRef(no),
            ..,
        ] = branch.operands.as_slice()
        else {
            return None;
        };
        Some(Self {
            condition: *condition,
            yes: *yes,
            no: *no,
            merge: id_at(merge, 0)?,
        })
    }

    /// The two instructions.
    pub fn instructions(self) -> [Instruction; 2] {
        let control = Operand::SelectionControl(SelectionControl::NONE);
        let merge = vec![Operand::IdRef(self.merge), control];
        let branch = [self.condition, self.yes, self.no].map(Operand::IdRef);
        [
            Instruction::new(Op::SelectionMerge, None, None, merge),
            Instruction::new(Op::BranchConditional, None, None, branch.to_vec()),
        ]
    }

    /// Puts the two instructions at the end of a block that has such.
    pub fn replace(self, block: &mut Block) {
        block.instructions.truncate(block.instructions.len() - 2);
        block.instructions.extend(self.instructions());
    }
}

pub(super) fn id_at(inst: &Instruction, at: usize) -> Option<u32> {
    match inst.operands.get(at) {
        Some(Operand::IdRef(id)) => Some(*id),
        _ => None,
    }
}

pub(super) fn label(block: &Block) -> u32 {
    block
        .label
        .as_ref()
        .and_then(|label| label.result_id)
        .unwrap_or(0)
}

pub(super) fn index(function: &Function) -> HashMap<u32, usize> {
    function
        .blocks
        .iter()
        .enumerate()
        .map(|(at, block)| (label(block), at))
        .collect()
}

/// The labels that the last instruction may go to. A label may occur twice.
pub(super) fn targets(block: &Block) -> impl Iterator<Item = u32> {
    let last = block.instructions.last();
    let skip = match last.map(|last| last.class.opcode) {
        Some(Op::Branch) => 0,
        Some(Op::BranchConditional | Op::Switch) => 1,
        _ => usize::MAX,
    };
    last.into_iter()
        .flat_map(|last| &last.operands)
        .filter_map(|operand| match operand {
            Operand::IdRef(id) => Some(*id),
            _ => None,
        })
        .skip(skip)
}

/// The blocks that lead to each block.
pub(super) fn predecessors(function: &Function) -> HashMap<u32, HashSet<u32>> {
    let mut found: HashMap<u32, HashSet<u32>> = HashMap::new();
    for block in &function.blocks {
        for target in targets(block) {
            found.entry(target).or_default().insert(label(block));
        }
    }
    found
}

/// Replaces the label `from` by `to` among the operands of `insts`.
pub(super) fn rename<'a>(insts: impl Iterator<Item = &'a mut Instruction>, from: u32, to: u32) {
    for operand in insts.flat_map(|inst| &mut inst.operands) {
        if *operand == Operand::IdRef(from) {
            *operand = Operand::IdRef(to);
        }
    }
}

pub(super) fn phis(block: &mut Block) -> impl Iterator<Item = &mut Instruction> {
    let is_phi = |inst: &&mut Instruction| inst.class.opcode == Op::Phi;
    block.instructions.iter_mut().take_while(is_phi)
}
