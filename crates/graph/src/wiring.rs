//! Who feeds whom: the links of a graph, indexed once for many questions, and orders of its nodes.
//!
//! It knows no node definitions, so sockets that do not exist are wired like others (`check` reports them). Links from
//! nodes that do not exist are kept as answers and skipped in orders. Everything is iterative: a chain of 10,000 nodes
//! needs no deep stack.

use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, HashMap};

use crate::document::{Graph, Link, SocketRef};

/// The index. Where two links lead into one input, the first counts.
pub struct Wiring<'d> {
    /// Sorted.
    ids: Vec<&'d str>,
    index: HashMap<&'d str, usize>,
    /// By node: what feeds its inputs, by input.
    incoming: Vec<BTreeMap<&'d str, &'d SocketRef>>,
    /// By node: the nodes that feed it, in order of its inputs.
    feeding: Vec<Vec<usize>>,
    /// By node: the links that start at it, in the graph's order.
    outgoing: Vec<Vec<&'d Link>>,
}

/// Nodes that feed each other in a ring: each one feeds the next, the last one the first.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the nodes {} feed each other in a ring; remove one of the links between them", nodes.join(", "))]
pub struct Cycle {
    /// Their ids, at least one.
    pub nodes: Vec<String>,
}

#[derive(Clone, Copy, PartialEq)]
enum State {
    New,
    Open,
    Done,
}

impl<'d> Wiring<'d> {
    /// Indexes the links of a graph.
    pub fn new(graph: &'d Graph) -> Wiring<'d> {
        let ids: Vec<&str> = graph.nodes.keys().map(String::as_str).collect();
        let index: HashMap<&str, usize> = ids.iter().enumerate().map(|(i, id)| (*id, i)).collect();
        let mut incoming = vec![BTreeMap::new(); ids.len()];
        let mut outgoing = vec![Vec::new(); ids.len()];
        for link in &graph.links {
            let Some(&to) = index.get(link.to.node.as_str()) else { continue };
            if let Entry::Vacant(entry) = incoming[to].entry(link.to.socket.as_str()) {
                entry.insert(&link.from);
                if let Some(&from) = index.get(link.from.node.as_str()) {
                    outgoing[from].push(link);
                }
            }
        }
        let feeding = |sockets: &BTreeMap<&str, &SocketRef>| {
            sockets.values().filter_map(|from| index.get(from.node.as_str()).copied()).collect()
        };
        let feeding = incoming.iter().map(feeding).collect();
        Wiring { ids, index, incoming, feeding, outgoing }
    }

    /// Whether the graph has this node.
    pub fn contains(&self, node: &str) -> bool {
        self.index.contains_key(node)
    }

    /// The output that feeds an input.
    pub fn incoming(&self, node: &str, input: &str) -> Option<&'d SocketRef> {
        self.incoming[*self.index.get(node)?].get(input).copied()
    }

    /// The fed inputs of a node and what feeds them, sorted by input.
    pub fn inputs(&self, node: &str) -> impl Iterator<Item = (&'d str, &'d SocketRef)> + '_ {
        let sockets = self.index.get(node).map(|&i| self.incoming[i].iter());
        sockets.into_iter().flatten().map(|(socket, from)| (*socket, *from))
    }

    /// The links from a node to inputs that they feed, in the graph's order.
    pub fn outgoing(&self, node: &str) -> &[&'d Link] {
        self.index.get(node).map_or(&[], |&i| self.outgoing[i].as_slice())
    }

    /// The nodes that `roots` are made of, themselves included, each after all that feed it. The same document gives the
    /// same order, whatever the order of its links. Roots that do not exist are skipped.
    pub fn order(&self, roots: &[&str]) -> Result<Vec<&'d str>, Cycle> {
        let roots = roots.iter().filter_map(|root| self.index.get(root).copied());
        match self.depth_first(roots) {
            (order, None) => Ok(order.into_iter().map(|i| self.ids[i]).collect()),
            (_, Some(cycle)) => Err(self.name_cycle(cycle)),
        }
    }

    /// All nodes, each after all that feed it, but for rings: there one link of each ring is overlooked.
    pub fn order_of_all(&self) -> Vec<&'d str> {
        self.depth_first(0..self.ids.len()).0.into_iter().map(|i| self.ids[i]).collect()
    }

    fn name_cycle(&self, nodes: Vec<usize>) -> Cycle {
        Cycle { nodes: nodes.into_iter().map(|i| self.ids[i].to_string()).collect() }
    }

    /// The nodes that feed node `i`, in order of its inputs.
    fn feeding(&self, i: usize) -> impl Iterator<Item = usize> + use<'_, 'd> {
        self.feeding[i].iter().copied()
    }

    /// Post-order of a depth-first walk against the links, and the first ring that it met, if any.
    fn depth_first(&self, roots: impl Iterator<Item = usize>) -> (Vec<usize>, Option<Vec<usize>>) {
        let mut state = vec![State::New; self.ids.len()];
        let mut order = Vec::new();
        let mut cycle = None;
        let mut path = Vec::new();
        for root in roots {
            if state[root] != State::New {
                continue;
            }
            state[root] = State::Open;
            path.push((root, self.feeding(root)));
            while let Some((node, feeding)) = path.last_mut() {
                match feeding.next() {
                    None => {
                        state[*node] = State::Done;
                        order.push(*node);
                        path.pop();
                    }
                    Some(next) if state[next] == State::New => {
                        state[next] = State::Open;
                        path.push((next, self.feeding(next)));
                    }
                    Some(next) if state[next] == State::Open && cycle.is_none() => {
                        // The path leads from each node to one that feeds it: backwards it is the ring.
                        let start = path.iter().position(|(node, _)| *node == next).unwrap_or(0);
                        cycle = Some(path[start..].iter().rev().map(|(node, _)| *node).collect());
                    }
                    Some(_) => {}
                }
            }
        }
        (order, cycle)
    }

    /// One ring for each group of nodes that feed each other, in order of the groups' first ids; none for a sound document.
    pub fn cycles(&self) -> Vec<Cycle> {
        let group = self.groups();
        let mut size = vec![0usize; self.ids.len()];
        group.iter().for_each(|&g| size[g] += 1);
        let mut told = vec![false; self.ids.len()];
        let mut cycles = Vec::new();
        for i in 0..self.ids.len() {
            let feeds_itself = self.feeding(i).any(|from| from == i);
            if told[group[i]] || (size[group[i]] == 1 && !feeds_itself) {
                continue;
            }
            told[group[i]] = true;
            cycles.push(self.name_cycle(self.ring_through(i, &group)));
        }
        cycles
    }

    /// A ring within the group of `start`: back along the links until a node comes again.
    fn ring_through(&self, start: usize, group: &[usize]) -> Vec<usize> {
        let mut seen = HashMap::new();
        let mut path = Vec::new();
        let mut node = start;
        loop {
            if let Some(&first) = seen.get(&node) {
                return path.split_off(first).into_iter().rev().collect();
            }
            seen.insert(node, path.len());
            path.push(node);
            match self.feeding(node).find(|&from| group[from] == group[start]) {
                Some(from) => node = from,
                None => return path,
            }
        }
    }

    /// The strongly connected component of each node, by number. Tarjan 1972, "Depth-first search and linear graph algorithms", with
    /// an explicit stack.
    fn groups(&self) -> Vec<usize> {
        const NONE: usize = usize::MAX;
        let n = self.ids.len();
        let (mut number, mut low, mut group) = (vec![NONE; n], vec![0; n], vec![NONE; n]);
        let (mut next_number, mut next_group) = (0, 0);
        let mut open = Vec::new();
        for root in 0..n {
            if number[root] != NONE {
                continue;
            }
            let mut path = vec![(root, self.feeding(root))];
            number[root] = next_number;
            low[root] = next_number;
            next_number += 1;
            open.push(root);
            while let Some((node, feeding)) = path.last_mut() {
                let node = *node;
                match feeding.next() {
                    Some(next) if number[next] == NONE => {
                        number[next] = next_number;
                        low[next] = next_number;
                        next_number += 1;
                        open.push(next);
                        path.push((next, self.feeding(next)));
                    }
                    Some(next) if group[next] == NONE => low[node] = low[node].min(number[next]),
                    Some(_) => {}
                    None => {
                        path.pop();
                        if let Some((parent, _)) = path.last() {
                            low[*parent] = low[*parent].min(low[node]);
                        }
                        if low[node] == number[node] {
                            while let Some(member) = open.pop() {
                                group[member] = next_group;
                                if member == node {
                                    break;
                                }
                            }
                            next_group += 1;
                        }
                    }
                }
            }
        }
        group
    }
}
