//! The shape of branches: every `if` with two arms becomes one or two `if`s with one arm.
//!
//! rust-gpu writes each selection as a diamond, two arms that meet, though most have one empty arm. `SwiftShader` walks
//! every path through a loop's body when it looks for the loop's back edge: its search marks a block as seen when it is
//! taken from the queue, not when it is put there (`Function::ExistsPath` in its `SpirvShaderControlFlow.cpp`), so a block
//! that two arms of equal length lead to is queued twice, and so is all that follows. Thirty diamonds in a row are 2^30
//! visits: pipeline creation never ends, and takes all memory. Where one of the two ways to the meeting point is
//! a direct edge, the block is seen before the other way arrives, and the search is short.
//!
//! An empty arm goes away. An `if` that has two arms with instructions becomes an `if` with the one and another with the
//! other, on the same condition; values that meet travel through the block between. Nothing that is computed changes.

mod selection;

use self::selection::{Selection, id_at, index, label, phis, predecessors, rename};
use rspirv::dr::{Block, Function, Instruction, Module, Operand};
use rspirv::spirv::Op;
use std::collections::{HashMap, HashSet};

/// Gives every selection in `module` one arm, as far as both of its arms end where they meet.
pub(crate) fn one_armed(module: &mut Module) {
    let mut next = Ids {
        next: module.header.as_ref().map_or(1, |header| header.bound),
        undefined: HashMap::new(),
    };
    for function in &mut module.functions {
        drop_empty_arms(function);
        split_arms(function, &mut next);
    }
    if let Some(header) = &mut module.header {
        header.bound = next.next;
    }
    let mut undefined: Vec<(u32, u32)> = next.undefined.into_iter().collect();
    undefined.sort_unstable_by_key(|&(_, id)| id);
    let made = |(ty, id)| Instruction::new(Op::Undef, Some(ty), Some(id), Vec::new());
    module.types_global_values.extend(undefined.into_iter().map(made));
}

/// Fresh ids, and an undefined value per type.
struct Ids {
    next: u32,
    undefined: HashMap<u32, u32>,
}

impl Ids {
    fn fresh(&mut self) -> u32 {
        let id = self.next;
        self.next += 1;
        id
    }

    fn undefined(&mut self, ty: u32) -> u32 {
        if let Some(&id) = self.undefined.get(&ty) {
            return id;
        }
        let id = self.fresh();
        self.undefined.insert(ty, id);
        id
    }
}

/// A branch to an arm without instructions goes to where the arms meet.
fn drop_empty_arms(function: &mut Function) {
    let at = index(function);
    let before = predecessors(function);
    // A block that a merge instruction names must stay.
    let named: HashSet<u32> = function
        .blocks
        .iter()
        .flat_map(|block| &block.instructions)
        .filter(|inst| matches!(inst.class.opcode, Op::SelectionMerge | Op::LoopMerge))
        .flat_map(|inst| &inst.operands)
        .filter_map(|operand| match operand {
            Operand::IdRef(id) => Some(*id),
            _ => None,
        })
        .collect();
    let mut gone = HashSet::new();
    for head in 0..function.blocks.len() {
        let Some(mut selection) = Selection::of(&function.blocks[head]) else {
            continue;
        };
        let merge = selection.merge;
        if selection.yes == selection.no || selection.yes == merge || selection.no == merge {
            continue;
        }
        let empty = |arm: u32| {
            let block = &function.blocks[at[&arm]];
            let [only] = block.instructions.as_slice() else {
                return false;
            };
            only.class.opcode == Op::Branch
                && id_at(only, 0) == Some(merge)
                && before.get(&arm).is_some_and(|from| from.len() == 1)
                && !named.contains(&arm)
        };
        let arm = if empty(selection.no) {
            std::mem::replace(&mut selection.no, merge)
        } else if empty(selection.yes) {
            std::mem::replace(&mut selection.yes, merge)
        } else {
            continue;
        };
        gone.insert(arm);
        let header = label(&function.blocks[head]);
        selection.replace(&mut function.blocks[head]);
        rename(phis(&mut function.blocks[at[&merge]]), arm, header);
    }
    function.blocks.retain(|block| !gone.contains(&label(block)));
}

/// `if c { A } else { B }` becomes `if c { A }` and `if c {} else { B }`.
fn split_arms(function: &mut Function, ids: &mut Ids) {
    let at = index(function);
    let mut before = predecessors(function);
    let headers: Vec<u32> = function.blocks.iter().map(label).collect();
    let mut between: HashMap<u32, Block> = HashMap::new();
    for header in headers {
        let Some(selection) = Selection::of(&function.blocks[at[&header]]) else {
            continue;
        };
        let Selection { yes, no, merge, .. } = selection;
        let alone = |arm: u32| before[&arm].len() == 1 && arm != merge;
        if yes == no || !alone(yes) || !alone(no) {
            continue;
        }
        let (mut from_yes, mut from_no) = (HashSet::new(), HashSet::new());
        let mut regular = true;
        for &from in &before[&merge] {
            match arm_of(from, header, selection, &before) {
                Some(arms) if arms == [yes] => regular &= from_yes.insert(from),
                Some(arms) if arms == [no] => regular &= from_no.insert(from),
                Some(arms) => regular &= arms.is_empty(),
                None => regular = false,
            }
        }
        if !regular || from_yes.is_empty() || from_no.is_empty() {
            continue;
        }

        let middle = ids.fresh();
        let mut block = Block::new();
        block.label = Some(Instruction::new(Op::Label, None, Some(middle), Vec::new()));
        for phi in phis(&mut function.blocks[at[&merge]]) {
            block
                .instructions
                .push(first_half(phi, &from_yes, header, middle, ids));
        }
        let second = Selection {
            yes: merge,
            ..selection
        };
        block.instructions.extend(second.instructions());
        between.insert(header, block);

        let first = Selection {
            no: middle,
            merge: middle,
            ..selection
        };
        first.replace(&mut function.blocks[at[&header]]);
        for from in &from_yes {
            rename(
                function.blocks[at[from]].instructions.last_mut().into_iter(),
                merge,
                middle,
            );
        }
        rename(phis(&mut function.blocks[at[&no]]), header, middle);

        let into_merge = before.entry(merge).or_default();
        into_merge.retain(|from| !from_yes.contains(from));
        into_merge.insert(middle);
        before.insert(no, HashSet::from([middle]));
        from_yes.insert(header);
        before.insert(middle, from_yes);
    }
    // The block between stands before all that it dominates.
    let blocks = std::mem::take(&mut function.blocks);
    for block in blocks {
        let middle = between.remove(&label(&block));
        function.blocks.push(block);
        function.blocks.extend(middle);
    }
}

/// The arms that `from`, which leads to the merge block, lies in; none when only the merge block itself leads there, and
/// `None` when the header does.
fn arm_of(
    from: u32,
    header: u32,
    selection: Selection,
    before: &HashMap<u32, HashSet<u32>>,
) -> Option<Vec<u32>> {
    let mut seen = HashSet::from([from]);
    let mut pending = vec![from];
    let mut arms = Vec::new();
    while let Some(id) = pending.pop() {
        if id == header {
            return None;
        } else if id == selection.yes || id == selection.no {
            arms.push(id);
        } else if id != selection.merge {
            pending.extend(
                before
                    .get(&id)
                    .into_iter()
                    .flatten()
                    .filter(|&&id| seen.insert(id)),
            );
        }
    }
    Some(arms)
}

/// Takes what comes from the blocks `from` out of `phi` and returns a phi of its own for it; `phi` gets its result, from
/// the block `middle`.
fn first_half(
    phi: &mut Instruction,
    from: &HashSet<u32>,
    header: u32,
    middle: u32,
    ids: &mut Ids,
) -> Instruction {
    let ty = phi.result_type.unwrap_or(0);
    let (first, second): (Vec<_>, Vec<_>) = phi
        .operands
        .chunks_exact(2)
        .map(<[Operand]>::to_vec)
        .partition(|pair| matches!(pair.as_slice(), [_, Operand::IdRef(block)] if from.contains(block)));
    // Never read: on the way from the header, the merge block is reached through the other arm.
    let other = ids.undefined(ty);
    let id = ids.fresh();
    let mut operands = first.concat();
    operands.extend([Operand::IdRef(other), Operand::IdRef(header)]);
    phi.operands = second.concat();
    phi.operands.extend([Operand::IdRef(id), Operand::IdRef(middle)]);
    Instruction::new(Op::Phi, Some(ty), Some(id), operands)
}
