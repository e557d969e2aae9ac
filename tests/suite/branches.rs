//! No branch of a kernel hangs on uniforms alone. Mesa's lavapipe takes such ones for settings that it had better compile
//! in (`lvp_inline_uniforms.c`), and so compiles the kernel anew for each dispatch, some 10 to 100 ms, and keeps each.
//! What is the same for a whole frame is written out as a constant instead.

use std::collections::HashMap;

use naga::{AddressSpace, Block, Expression, Function, Handle, Module, Statement};

use super::tidy::kernels;

/// What a value hangs on at most.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum On {
    Constants,
    Uniforms,
    More,
}

/// A function with what its arguments hang on.
struct Reading<'m> {
    module: &'m Module,
    function: &'m Function,
    arguments: &'m [On],
    /// Of local variables: what is stored there, at first all of it together, then what is there at a place.
    locals: Locals,
    /// Of what has been worked out on the way: a variable may have another value since.
    known: HashMap<Handle<Expression>, On>,
}

type Locals = HashMap<Handle<naga::LocalVariable>, On>;

impl Reading<'_> {
    /// A uniform at a place that is known beforehand, or a local variable.
    fn place(&self, pointer: Handle<Expression>) -> On {
        match self.function.expressions[pointer] {
            Expression::GlobalVariable(variable) => match self.module.global_variables[variable].space {
                AddressSpace::Uniform => On::Uniforms,
                _ => On::More,
            },
            Expression::LocalVariable(variable) => self.locals.get(&variable).copied().unwrap_or(On::Constants),
            Expression::AccessIndex { base, .. } => self.place(base),
            Expression::Access { base, index } => self.place(base).max(match self.on(index) {
                On::Constants => On::Constants,
                _ => On::More,
            }),
            _ => On::More,
        }
    }

    fn on(&self, value: Handle<Expression>) -> On {
        if let Some(&on) = self.known.get(&value) {
            return on;
        }
        let all = |values: &[Handle<Expression>]| values.iter().map(|v| self.on(*v)).max().unwrap_or(On::Constants);
        match &self.function.expressions[value] {
            Expression::Literal(_) | Expression::Constant(_) | Expression::ZeroValue(_) => On::Constants,
            Expression::Load { pointer } => self.place(*pointer),
            Expression::FunctionArgument(i) => self.arguments.get(*i as usize).copied().unwrap_or(On::More),
            Expression::Compose { components, .. } => all(components),
            Expression::Splat { value, .. } => self.on(*value),
            Expression::AccessIndex { base, .. } => self.on(*base),
            Expression::Access { base, index } => all(&[*base, *index]),
            Expression::Swizzle { vector, .. } => self.on(*vector),
            Expression::Unary { expr, .. } | Expression::As { expr, .. } => self.on(*expr),
            Expression::Binary { left, right, .. } => all(&[*left, *right]),
            Expression::Select { condition, accept, reject } => all(&[*condition, *accept, *reject]),
            Expression::Math { arg, arg1, arg2, arg3, .. } => {
                all(&[Some(*arg), *arg1, *arg2, *arg3].into_iter().flatten().collect::<Vec<_>>())
            }
            _ => On::More,
        }
    }

    /// Goes through all statements, those in blocks too, with what decides whether they are reached.
    fn each<'b>(&self, block: &'b Block, under: On, see: &mut impl FnMut(&'b Statement, On)) {
        for statement in block {
            see(statement, under);
            match statement {
                Statement::Block(block) => self.each(block, under, see),
                Statement::If { condition, accept, reject } => {
                    let under = under.max(self.on(*condition));
                    self.each(accept, under, see);
                    self.each(reject, under, see);
                }
                Statement::Switch { selector, cases } => {
                    let under = under.max(self.on(*selector));
                    for case in cases {
                        self.each(&case.body, under, see);
                    }
                }
                Statement::Loop { body, continuing, .. } => {
                    self.each(body, under, see);
                    self.each(continuing, under, see);
                }
                _ => {}
            }
        }
    }

    /// The local variable that a pointer leads to.
    fn local(&self, pointer: Handle<Expression>) -> Option<Handle<naga::LocalVariable>> {
        match self.function.expressions[pointer] {
            Expression::LocalVariable(variable) => Some(variable),
            Expression::AccessIndex { base, .. } | Expression::Access { base, .. } => self.local(base),
            _ => None,
        }
    }
}

impl Reading<'_> {
    /// Finds what local variables hang on, wherever they are read.
    fn settle(&mut self) {
        for (variable, local) in self.function.local_variables.iter() {
            let on = local.init.map_or(On::Constants, |init| self.on(init));
            self.locals.insert(variable, on);
        }
        // What is stored may hang on what is stored elsewhere: until nothing changes. A pointer that is handed on counts
        // as a store of anything.
        loop {
            let before = self.locals.clone();
            let mut stores = Vec::new();
            self.each(&self.function.body, On::Constants, &mut |statement, under| match statement {
                Statement::Store { pointer, value } => stores.push((*pointer, under.max(self.on(*value)))),
                Statement::Call { arguments, .. } => stores.extend(arguments.iter().map(|a| (*a, On::More))),
                _ => {}
            });
            for (pointer, on) in stores {
                if let Some(variable) = self.local(pointer) {
                    let known = self.locals.entry(variable).or_insert(on);
                    *known = on.max(*known);
                }
            }
            if before == self.locals {
                return;
            }
        }
    }

    /// Goes through a block from its begin to its end, with what each variable hangs on there: in the first turn of a loop
    /// that is written out, a variable is still what it was set to. `settled` is what it hangs on anywhere.
    fn go(&mut self, block: &Block, settled: &Locals, found: &mut Vec<String>) {
        let name = self.function.name.clone().unwrap_or_default();
        for statement in block {
            match statement {
                Statement::Emit(range) => {
                    for value in range.clone() {
                        let on = self.on(value);
                        self.known.insert(value, on);
                    }
                }
                Statement::Store { pointer, value } => {
                    let on = self.on(*value);
                    let all_of_it = matches!(self.function.expressions[*pointer], Expression::LocalVariable(_));
                    if let Some(variable) = self.local(*pointer) {
                        let old = if all_of_it { On::Constants } else { self.locals[&variable] };
                        self.locals.insert(variable, on.max(old));
                    }
                }
                Statement::Call { function, arguments, .. } => {
                    let own: Vec<_> = arguments.iter().map(|a| self.on(*a)).collect();
                    let handed: Vec<_> = arguments.iter().filter_map(|a| self.local(*a)).collect();
                    for variable in handed {
                        self.locals.insert(variable, On::More);
                    }
                    read(self.module, &self.module.functions[*function], &own, found);
                }
                Statement::Block(block) => self.go(block, settled, found),
                Statement::If { condition, accept, reject } => {
                    let on = self.on(*condition);
                    if on == On::Uniforms {
                        found.push(format!("{name}: if"));
                    }
                    self.part(on, &[accept, reject], settled, found);
                }
                Statement::Switch { selector, cases } => {
                    let on = self.on(*selector);
                    if on == On::Uniforms {
                        found.push(format!("{name}: switch"));
                    }
                    let bodies: Vec<&Block> = cases.iter().map(|case| &case.body).collect();
                    self.part(on, &bodies, settled, found);
                }
                Statement::Loop { body, continuing, .. } => {
                    self.locals.clone_from(settled);
                    self.go(body, settled, found);
                    self.go(continuing, settled, found);
                    self.locals.clone_from(settled);
                }
                _ => {}
            }
        }
    }

    /// Goes through blocks of which one is taken: what is stored in any of them hangs on the choice, too.
    fn part(&mut self, on: On, blocks: &[&Block], settled: &Locals, found: &mut Vec<String>) {
        let before = self.locals.clone();
        let mut after = before.clone();
        for block in blocks {
            self.locals.clone_from(&before);
            self.go(block, settled, found);
            let mut stored = Vec::new();
            self.each(block, On::Constants, &mut |statement, _| match statement {
                Statement::Store { pointer, .. } => stored.extend(self.local(*pointer)),
                Statement::Call { arguments, .. } => stored.extend(arguments.iter().filter_map(|a| self.local(*a))),
                _ => {}
            });
            for variable in stored {
                let then = self.locals[&variable].max(on);
                after.entry(variable).and_modify(|all| *all = then.max(*all));
            }
        }
        self.locals = after;
    }
}

/// Fills what hangs on uniforms alone into `found`, function by function from `function` down.
fn read(module: &Module, function: &Function, arguments: &[On], found: &mut Vec<String>) {
    let mut reading = Reading { module, function, arguments, locals: HashMap::new(), known: HashMap::new() };
    reading.settle();
    let settled = reading.locals.clone();
    for (variable, local) in function.local_variables.iter() {
        let on = local.init.map_or(On::Constants, |init| reading.on(init));
        reading.locals.insert(variable, on);
    }
    reading.go(&function.body, &settled, found);
}

fn on_uniforms_alone(module: &Module) -> Vec<String> {
    let mut found = Vec::new();
    let entry = &module.entry_points[0].function;
    read(module, entry, &vec![On::More; entry.arguments.len()], &mut found);
    found
}

#[test]
fn no_branch_hangs_on_uniforms_alone() {
    let all = kernels();
    let found: Vec<_> = all.iter().map(|(name, module, _)| (name, on_uniforms_alone(module))).collect();
    let found: Vec<_> = found.iter().filter(|(_, branches)| !branches.is_empty()).collect();
    assert!(found.is_empty(), "{found:?}");
}

#[test]
fn branches_that_hang_on_uniforms_alone_are_seen() {
    let within = |body: &str| {
        let text = format!(
            "struct Set {{ kind: u32, count: u32 }}
             @group(0) @binding(0) var<uniform> by: Set;
             @group(0) @binding(1) var<storage, read_write> sums: array<u32>;
             fn kind_of(kind: u32) -> u32 {{ if (kind == 3u) {{ return 1u; }} return 2u; }}
             @compute @workgroup_size(64) fn main(@builtin(local_invocation_index) lane: u32) {{ {body} }}"
        );
        on_uniforms_alone(&naga::front::wgsl::parse_str(&text).unwrap_or_else(|e| panic!("{e}"))).len()
    };
    for (body, branches) in [
        ("if (by.kind == 1u) { sums[lane] = 1u; }", 1),
        ("for (var i = 0u; i < by.count; i++) { sums[lane] += i; }", 1),
        ("switch (by.kind) { case 1u: { sums[lane] = 1u; } default: {} }", 1),
        ("sums[lane] = kind_of(by.kind);", 1),
        ("var i = 0u; if (i < by.count) { i = lane; } if (i < by.count) { sums[lane] = i; }", 1),
        ("if (lane < by.count) { sums[lane] = kind_of(lane); }", 0),
        ("for (var i = lane; i < by.count; i++) { sums[lane] += select(i, 1u, by.kind == 1u); }", 0),
        ("sums[lane] = kind_of(4u); for (var i = 0u; i < 4u; i++) { sums[i] = i; }", 0),
    ] {
        assert_eq!(within(body), branches, "{body}");
    }
}
