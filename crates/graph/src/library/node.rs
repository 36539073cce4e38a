//! A node definition: the doc comment (`grammar`) held against the signature (`signature`).

use halfvector_shaders::ItemKind;

use super::grammar::{self, ArgumentDoc, DefaultDoc, NodeDoc};
use super::signature::{ArgumentType, ResultType, SURFACE_STRUCT, Signature, Signatures};
use super::{LibraryProblem, Source, line_of};
use crate::context::{FRAMES, context, frame};
use crate::method::term;
use crate::node_def::{Argument, Default, Function, Input, NodeDef, Output, REROUTE};
use crate::value::{SocketType, Type, Value};

/// Reads the nodes of a file. Names of functions that are nodes or stand in for one go to `taken`.
pub(super) fn read_nodes(
    source: &Source,
    signatures: &Signatures,
    taken: &mut Vec<String>,
    problems: &mut Vec<LibraryProblem>,
) -> Vec<NodeDef> {
    let mut defs = Vec::new();
    for item in source.items.iter().filter(|item| item.kind == ItemKind::Fn) {
        let first = line_of(source.text, item.start);
        let lines = grammar::doc_lines(&source.text[item.start..item.code_start], first);
        let mut reader = Reader { source, signatures, slips: Vec::new() };
        if grammar::is_node(&lines) {
            let doc = grammar::read(&lines, &mut reader.slips);
            taken.push(item.name.clone());
            taken.extend(doc.vertex.iter().map(|(_, function)| function.clone()));
            taken.extend(doc.methods.iter().map(|(_, _, _, function)| function.clone()));
            taken.extend(doc.outputs.iter().map(|(_, _, function)| function.clone()));
            let def = reader.node(&doc, &item.name);
            if reader.slips.is_empty() {
                defs.extend(def);
            }
        } else if let Some((line, _)) = lines.iter().find(|(_, text)| text.starts_with('@')) {
            reader.slips.push((*line, "an @ line without `@node`: this function is no node".into()));
        }
        problems.extend(reader.slips.into_iter().map(|(line, message)| LibraryProblem {
            file: source.path.into(),
            line,
            message,
        }));
    }
    if defs.len() > 1 && !source.generic.is_empty() {
        let message = "a generic file holds one node; give each node its own file".into();
        problems.push(LibraryProblem { file: source.path.into(), line: 1, message });
    }
    defs
}

/// Reports functions that are named as a node's and are none: their comment has no `@node`.
pub(super) fn refuse_forgotten(sources: &[Source], taken: &[String], problems: &mut Vec<LibraryProblem>) {
    let taken: std::collections::HashSet<&str> = taken.iter().map(String::as_str).collect();
    for source in sources {
        for item in source.items.iter().filter(|item| item.kind == ItemKind::Fn && item.name.starts_with("node_")) {
            if !taken.contains(item.name.as_str()) {
                problems.push(LibraryProblem {
                    file: source.path.into(),
                    line: line_of(source.text, item.code_start),
                    message: format!("`{}` is named as a node, but no comment makes it one", item.name),
                });
            }
        }
    }
}

struct Reader<'s> {
    source: &'s Source<'s>,
    signatures: &'s Signatures,
    slips: Vec<grammar::Slip>,
}

impl Reader<'_> {
    fn slip(&mut self, line: usize, message: impl Into<String>) {
        self.slips.push((line, message.into()));
    }

    fn node(&mut self, doc: &NodeDoc, function: &str) -> Option<NodeDef> {
        self.names(doc, function);
        let signature = self.signatures.get(self.source, function)?;
        let inputs = self.inputs(doc, &signature);
        let outputs = self.outputs(doc, &signature);
        let is_generic = |ty: SocketType| ty == SocketType::Generic;
        if !self.source.generic.is_empty() && !inputs.iter().any(|input| is_generic(input.ty)) {
            self.slip(doc.line, "no argument is of type T, so T is never known");
        }
        let mut def = NodeDef {
            id: doc.id.clone(),
            label: doc.label.clone(),
            help: doc.help.clone(),
            synonyms: doc.synonyms.clone(),
            inputs,
            outputs,
            generic: self.source.generic.clone(),
            file: self.source.path.into(),
            function: Function {
                name: function.into(),
                arguments: Vec::new(),
                returns_struct: returns_struct(&signature),
                implicit_derivatives: signature.implicit_derivatives,
            },
            vertex_function: None,
            slopes: Vec::new(),
            method_functions: Vec::new(),
            output_functions: Vec::new(),
            forwards: doc.id == REROUTE,
        };
        def.function.arguments = self.arguments(doc.line, &signature, &def.inputs);
        self.stand_ins(doc, &mut def);
        self.slopes(doc, &mut def);
        Some(def)
    }

    /// The function's and the folder's names follow from the id.
    fn names(&mut self, doc: &NodeDoc, function: &str) {
        let wanted = format!("node_{}", doc.id.replace('/', "_"));
        if function != wanted {
            self.slip(doc.line, format!("the function of the node `{}` is named `{wanted}`, not `{function}`", doc.id));
        }
        let category = doc.id.split('/').next().unwrap_or("");
        if !self.source.path.starts_with(&format!("nodes/{category}/")) {
            self.slip(doc.line, format!("the node `{}` belongs into a file under nodes/{category}/", doc.id));
        }
    }

    fn inputs(&mut self, doc: &NodeDoc, signature: &Signature) -> Vec<Input> {
        for argument in &doc.arguments {
            if !signature.arguments.iter().any(|(name, _)| *name == argument.name) {
                self.slip(argument.line, format!("the function has no argument `{}`", argument.name));
            }
        }
        let mut inputs = Vec::new();
        for (i, (name, ty)) in signature.arguments.iter().enumerate() {
            let described = doc.arguments.iter().find(|argument| argument.name == *name);
            match (ty, described) {
                (ArgumentType::Socket(ty), Some(described)) => {
                    if *ty == SocketType::Texture
                        && signature.arguments.get(i + 1) != Some(&(format!("{name}_sampler"), ArgumentType::Sampler))
                    {
                        self.slip(described.line, format!("the texture `{name}` is followed by `{name}_sampler: sampler`"));
                    }
                    if let Some(default) = self.default(described, *ty) {
                        inputs.push(Input {
                            name: name.clone(),
                            label: None,
                            ty: *ty,
                            default,
                            range: described.range,
                            unit: described.unit.clone(),
                            help: described.help.clone(),
                        });
                    }
                }
                (ArgumentType::Socket(_), None) => {
                    self.slip(doc.line, format!("the argument `{name}` has no line `- {name}: help [default]`"));
                }
                (ArgumentType::Sampler, None) => {}
                (ArgumentType::Sampler, Some(described)) => {
                    self.slip(described.line, "a sampler goes with its texture and has no line");
                }
                (ArgumentType::Matrix, None) if frame(name).is_some() => {}
                (ArgumentType::Matrix, Some(described)) if frame(name).is_some() => {
                    self.slip(described.line, "a transform between spaces is no socket and has no line");
                }
                (ArgumentType::Matrix, _) => {
                    let known: Vec<&str> = FRAMES.iter().map(|f| f.name).collect();
                    self.slip(doc.line, format!("`{name}` is no transform between spaces; there are {}", known.join(", ")));
                }
                (ArgumentType::Other, _) => self.slip(
                    doc.line,
                    format!(
                        "no socket has the type of `{name}`; arguments are bool, i32, f32, vec2f, vec3f, vec4f, T, Surface, or texture_2d<f32> with its sampler"
                    ),
                ),
            }
        }
        inputs
    }

    fn default(&mut self, argument: &ArgumentDoc, ty: SocketType) -> Option<Default> {
        let (line, name) = (argument.line, &argument.name);
        if let (DefaultDoc::Numbers(numbers), Some([lo, hi])) = (&argument.default, argument.range)
            && numbers.iter().any(|x| !(lo..=hi).contains(x))
        {
            self.slip(line, format!("the default of `{name}` lies outside its range"));
        }
        if argument.range.is_some()
            && matches!(ty, SocketType::Texture | SocketType::Surface | SocketType::Value(Type::Bool))
        {
            self.slip(line, format!("`{name}` has no range: it is no number"));
        }
        let default = match (&argument.default, ty) {
            (DefaultDoc::Image(space), SocketType::Texture) => Ok(Default::Image(*space)),
            (_, SocketType::Texture) => Err("a texture's default is `image srgb` or `image linear`".into()),
            (DefaultDoc::Surface, SocketType::Surface) => Ok(Default::Surface),
            (_, SocketType::Surface) => Err("a surface's default is `surface`: it must be linked".into()),
            (DefaultDoc::Surface, _) => Err("only a surface has `surface` as default".into()),
            (DefaultDoc::Image(_), _) => Err("only a texture has an image as default".into()),
            (DefaultDoc::Context(given), SocketType::Value(ty)) => match context(given) {
                Some(context) if context.ty == ty => Ok(Default::Context(given.clone())),
                Some(context) => {
                    Err(format!("the context `{given}` is a {}, `{name}` a {}", context.ty.wgsl(), ty.wgsl()))
                }
                None => {
                    let known: Vec<&str> = crate::context::CONTEXTS.iter().map(|c| c.name).collect();
                    Err(format!("there is no context `{given}`; there are {}", known.join(", ")))
                }
            },
            (DefaultDoc::Context(_), _) => Err("an argument of type T cannot have a context as default".into()),
            (DefaultDoc::Bool(b), SocketType::Value(Type::Bool)) => Ok(Default::Value(Value::Bool(*b))),
            (DefaultDoc::Numbers(numbers), SocketType::Generic) if numbers.len() == 1 => {
                Ok(Default::Value(Value::Number(numbers[0])))
            }
            (_, SocketType::Generic) => Err("a default of type T is one number".into()),
            (DefaultDoc::Numbers(numbers), SocketType::Value(ty)) => {
                number_default(numbers, ty).ok_or_else(|| format!("the default does not fit the type {}", ty.wgsl()))
            }
            (_, _) => Err("the default does not fit the type".into()),
        };
        default.map_err(|message: String| self.slip(line, format!("`{name}`: {message}"))).ok()
    }

    fn outputs(&mut self, doc: &NodeDoc, signature: &Signature) -> Vec<Output> {
        let help = doc.result.as_ref().map_or(String::new(), |(_, help)| help.clone());
        match &signature.result {
            ResultType::Struct { name, .. } if name == SURFACE_STRUCT => {
                vec![Output { name: "out".into(), label: None, ty: SocketType::Surface, help }]
            }
            ResultType::Plain(ArgumentType::Socket(ty @ (SocketType::Value(_) | SocketType::Generic))) => {
                vec![Output { name: "out".into(), label: None, ty: *ty, help }]
            }
            ResultType::Struct { name, members } => {
                if let Some((line, _)) = &doc.result {
                    self.slip(
                        *line,
                        format!("the function returns a struct: describe the members of `{name}` instead"),
                    );
                }
                let mut outputs = Vec::new();
                for member in members {
                    match member.ty {
                        ArgumentType::Socket(ty @ (SocketType::Value(_) | SocketType::Generic)) => {
                            outputs.push(Output {
                                name: member.name.clone(),
                                label: None,
                                ty,
                                help: member.help.clone(),
                            });
                        }
                        _ => self.slip(doc.line, format!("no socket has the type of `{name}.{}`", member.name)),
                    }
                    if member.help.is_empty() {
                        self.slip(doc.line, format!("`{name}.{}` has no `///` comment", member.name));
                    }
                }
                outputs
            }
            ResultType::None | ResultType::Plain(_) => {
                self.slip(doc.line, "a node returns bool, i32, f32, vec2f, vec3f, vec4f, T or a struct of these");
                Vec::new()
            }
        }
    }

    /// The arguments of a function in terms of the node's inputs: all names and types must be the node's.
    fn arguments(&mut self, line: usize, signature: &Signature, inputs: &[Input]) -> Vec<Argument> {
        let mut arguments = Vec::new();
        for (name, ty) in &signature.arguments {
            let input = |name: &str| inputs.iter().find(|input| input.name == name);
            match ty {
                ArgumentType::Sampler => match name.strip_suffix("_sampler").and_then(input) {
                    Some(texture) if texture.ty == SocketType::Texture => {
                        arguments.push(Argument::Sampler(texture.name.clone()));
                    }
                    _ => self.slip(line, format!("the sampler `{name}` belongs to no texture of the node")),
                },
                ArgumentType::Matrix if frame(name).is_some() => {
                    arguments.extend(frame(name).map(|frame| Argument::Frame(frame.name)));
                }
                ArgumentType::Socket(ty) if input(name).is_some_and(|input| input.ty == *ty) => {
                    arguments.push(Argument::Input(name.clone()));
                }
                // Said already, where the node's own arguments were read.
                _ if self.slips.iter().any(|(slip, _)| *slip == line) => {}
                _ => self.slip(line, format!("the argument `{name}` is no input of the node, or of another type")),
            }
        }
        arguments
    }

    /// The functions that stand in for the node's own: `@vertex`, `@method`, `@output`.
    fn stand_ins(&mut self, doc: &NodeDoc, def: &mut NodeDef) {
        let own = self.signatures.get(self.source, &def.function.name);
        let own_result = own.map(|signature| signature.result);
        if let Some((line, name)) = &doc.vertex {
            def.vertex_function = self.vertex_stand_in(*line, name, def, own_result.as_ref());
        }
        for (line, term_name, method, name) in &doc.methods {
            let known = term(term_name).is_some_and(|term| term.methods.iter().any(|m| m.name == method));
            if !known {
                self.slip(*line, format!("there is no method `{term_name}={method}`"));
            }
            if let Some(function) = self.stand_in_of_type(*line, name, def, own_result.as_ref()) {
                def.method_functions.push((term_name.clone(), method.clone(), function));
            }
        }
        for (line, output, name) in &doc.outputs {
            let Some(ty) = def.outputs.iter().find(|o| o.name == *output).map(|o| o.ty) else {
                self.slip(*line, format!("the node has no output `{output}`"));
                continue;
            };
            if let Some((function, result)) = self.stand_in(*line, name, def) {
                if result != ResultType::Plain(ArgumentType::Socket(ty)) {
                    self.slip(*line, format!("`{name}` does not return the type of `{output}`"));
                }
                def.output_functions.push((output.clone(), function));
            }
        }
    }

    /// The inputs of `@slope`.
    fn slopes(&mut self, doc: &NodeDoc, def: &mut NodeDef) {
        for (line, name) in &doc.slopes {
            if def.slopes.contains(name) {
                self.slip(*line, format!("`@slope {name}` stands twice"));
            } else if def.inputs.iter().any(|input| input.name == *name) {
                def.slopes.push(name.clone());
            } else {
                self.slip(*line, format!("`@slope {name}`: the function has no argument `{name}`"));
            }
        }
    }

    /// A function for the vertex stage.
    fn vertex_stand_in(
        &mut self,
        line: usize,
        name: &str,
        def: &NodeDef,
        result: Option<&ResultType>,
    ) -> Option<Function> {
        let function = self.stand_in_of_type(line, name, def, result)?;
        if function.implicit_derivatives {
            self.slip(line, format!("`{name}` takes implicit derivatives, which the vertex stage has not"));
        }
        Some(function)
    }

    /// A function that returns what the node does.
    fn stand_in_of_type(
        &mut self,
        line: usize,
        name: &str,
        def: &NodeDef,
        result: Option<&ResultType>,
    ) -> Option<Function> {
        let (function, found) = self.stand_in(line, name, def)?;
        if Some(&found) != result {
            self.slip(line, format!("`{name}` returns another type than the node"));
        }
        Some(function)
    }

    fn stand_in(&mut self, line: usize, name: &str, def: &NodeDef) -> Option<(Function, ResultType)> {
        let Some(signature) = self.signatures.get(self.source, name) else {
            self.slip(line, format!("there is no function `{name}`"));
            return None;
        };
        let arguments = self.arguments(line, &signature, &def.inputs);
        let function = Function {
            name: name.into(),
            arguments,
            returns_struct: returns_struct(&signature),
            implicit_derivatives: signature.implicit_derivatives,
        };
        Some((function, signature.result))
    }
}

/// Whether the outputs are members of the result; a `Surface` is one output.
fn returns_struct(signature: &Signature) -> bool {
    matches!(&signature.result, ResultType::Struct { name, .. } if name != SURFACE_STRUCT)
}

/// A default of a value socket: one number is spread over a vector.
fn number_default(numbers: &[f32], ty: Type) -> Option<Default> {
    let value = match *numbers {
        [x] if ty.components() == 1 => Value::Number(x),
        [x] => return number_default(&vec![x; ty.components()], ty),
        [x, y] => Value::Vec2([x, y]),
        [x, y, z] => Value::Vec3([x, y, z]),
        [x, y, z, w] => Value::Vec4([x, y, z, w]),
        _ => return None,
    };
    value.components_as(ty).map(|_| Default::Value(value))
}
