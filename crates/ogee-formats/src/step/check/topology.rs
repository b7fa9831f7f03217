//! Loops close, edges are shared as a shell wants it, shells are in one piece.

use std::collections::HashMap;

use super::model::{Bound, Model, Shell};
use super::{Fault, Faults};

/// Checks all shells; returns the edges of each that are used once.
pub(super) fn check(model: &Model, faults: &mut Faults) -> Vec<Vec<usize>> {
    let mut free = Vec::with_capacity(model.shells.len());
    for shell in &model.shells {
        for face in &shell.faces {
            for bound in &face.bounds {
                closes(model, bound, faults);
            }
        }
        free.push(edge_uses(model, shell, faults));
        connected(shell, faults);
    }
    free
}

/// Every edge of a loop begins where the one before it ends.
fn closes(model: &Model, bound: &Bound, faults: &mut Faults) {
    let ends = |k: usize| {
        let used = bound.uses[k];
        let [start, end] = model.edges[used.edge].vertices;
        if used.forward { [start, end] } else { [end, start] }
    };
    for k in 0..bound.uses.len() {
        let next = (k + 1) % bound.uses.len();
        if ends(k)[1] != ends(next)[0] {
            let [one, other] = [k, next].map(|k| model.edges[bound.uses[k].edge].id);
            let message = format!("the loop is open between its edges #{one} and #{other}");
            faults.push(Fault { code: "open_loop", message, line: Some(bound.line), id: Some(bound.id) });
        }
    }
}

/// In a closed shell every edge is used twice, in an open one at most twice, and never twice the same way.
/// Returns those that are used once.
fn edge_uses(model: &Model, shell: &Shell, faults: &mut Faults) -> Vec<usize> {
    let mut uses: HashMap<usize, [usize; 2]> = HashMap::new();
    for used in shell.faces.iter().flat_map(|face| &face.bounds).flat_map(|bound| &bound.uses) {
        uses.entry(used.edge).or_default()[usize::from(used.forward)] += 1;
    }
    let mut uses: Vec<_> = uses.into_iter().collect();
    uses.sort_unstable();
    let mut free = Vec::new();
    for (place, [backward, forward]) in uses {
        let edge = &model.edges[place];
        let mut fault = |code, message| {
            faults.push(Fault { code, message, line: Some(edge.line), id: Some(edge.id) });
        };
        match [backward, forward] {
            [1, 1] => {}
            [0, 1] | [1, 0] => {
                free.push(place);
                if shell.closed && shell.complete {
                    fault("edge_used_once", format!("closed shell #{} uses the edge once only", shell.id));
                }
            }
            [0, 2] | [2, 0] => {
                fault("edge_same_direction", format!("shell #{} uses the edge twice the same way", shell.id));
            }
            _ => {
                let times = backward + forward;
                fault("edge_used_too_often", format!("shell #{} uses the edge {times} times", shell.id));
            }
        }
    }
    free
}

/// From face to face over common edges, all of a shell can be reached.
fn connected(shell: &Shell, faults: &mut Faults) {
    let mut by_edge: HashMap<usize, Vec<usize>> = HashMap::new();
    for (f, face) in shell.faces.iter().enumerate() {
        for used in face.bounds.iter().flat_map(|bound| &bound.uses) {
            by_edge.entry(used.edge).or_default().push(f);
        }
    }
    let mut reached = vec![false; shell.faces.len()];
    let mut waiting = Vec::new();
    let mut pieces = 0;
    for seed in 0..shell.faces.len() {
        if reached[seed] {
            continue;
        }
        pieces += 1;
        reached[seed] = true;
        waiting.push(seed);
        while let Some(f) = waiting.pop() {
            for used in shell.faces[f].bounds.iter().flat_map(|bound| &bound.uses) {
                for other in by_edge.remove(&used.edge).unwrap_or_default() {
                    if !reached[other] {
                        reached[other] = true;
                        waiting.push(other);
                    }
                }
            }
        }
    }
    if pieces > 1 && shell.complete {
        let message = format!("the shell is in {pieces} pieces that share no edge");
        faults.push(Fault {
            code: "shell_not_connected",
            message,
            line: Some(shell.line),
            id: Some(shell.id),
        });
    }
}
