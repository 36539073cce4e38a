//! `--set NAME=VALUE`: a parameter that the material exposes, set by the type of its socket.

use halfvector_graph::document::{Document, Node, SocketRef};
use halfvector_graph::library::Library;
use halfvector_graph::node_def::Default as InputDefault;
use halfvector_graph::value::{ColorSpace, ImageRef, SocketType, Type, Value};

/// `NAME=VALUE` as written.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Assignment {
    name: String,
    value: String,
}

/// Cuts `NAME=VALUE`.
pub(crate) fn parse_assignment(text: &str) -> Result<Assignment, String> {
    match text.split_once('=') {
        Some((name, value)) if !name.trim().is_empty() && !value.trim().is_empty() => {
            Ok(Assignment { name: name.trim().to_owned(), value: value.trim().to_owned() })
        }
        _ => Err("write PARAMETER=VALUE, such as metallic=1 or base_color=1,0.5,0.2".to_owned()),
    }
}

/// Sets a parameter of a document. The error says what was wrong and what there is.
pub(crate) fn set(document: &mut Document, library: &Library, assignment: &Assignment) -> Result<(), String> {
    let Assignment { name, value } = assignment;
    let Some(socket) = document.parameter(name).map(|parameter| parameter.socket.clone()) else {
        let names: Vec<_> = document.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
        return Err(if names.is_empty() {
            format!("the material `{}` exposes no parameters, so `{name}` cannot be set", document.name)
        } else {
            format!("the material `{}` has no parameter `{name}`; it has {}", document.name, names.join(", "))
        });
    };
    let value = typed(document, library, &socket, value).map_err(|why| format!("{name}={value}: {why}"))?;
    let node: &mut Node = document
        .graph
        .nodes
        .get_mut(&socket.node)
        .ok_or_else(|| format!("`{name}` stands for {socket}, which is missing"))?;
    node.values.insert(socket.socket, value);
    Ok(())
}

fn typed(document: &Document, library: &Library, socket: &SocketRef, text: &str) -> Result<Value, String> {
    let missing = || format!("it stands for {socket}, which is missing");
    let node = document.graph.nodes.get(&socket.node).ok_or_else(missing)?;
    let library = library.of(document);
    let definition = library.get(&node.node).ok_or_else(missing)?;
    let input = definition.inputs.iter().find(|input| input.name == socket.socket).ok_or_else(missing)?;
    match input.ty {
        SocketType::Value(Type::Bool) => match text {
            "true" => Ok(Value::Bool(true)),
            "false" => Ok(Value::Bool(false)),
            _ => Err("it takes true or false".to_owned()),
        },
        SocketType::Value(Type::I32) if Value::from_digits(text).is_some() => {
            let value = Value::from_digits(text).filter(|value| value.components_as(Type::I32).is_some());
            value.ok_or_else(|| format!("it takes a whole number from {} to {}", i32::MIN, i32::MAX))
        }
        SocketType::Value(ty) => {
            let numbers = numbers(text)?;
            let value = match (numbers[..].len(), ty) {
                (1, Type::Vec2) => Value::Vec2([numbers[0]; 2]),
                (1, Type::Vec3) => Value::Vec3([numbers[0]; 3]),
                (1, Type::Vec4) => Value::Vec4([numbers[0]; 4]),
                (count, ty) if count == ty.components() => vector(&numbers)?,
                (count, ty) => {
                    return Err(format!(
                        "it takes {} separated by commas, and {count} were given",
                        plural(ty.components())
                    ));
                }
            };
            Ok(value)
        }
        SocketType::Generic => match (numbers(text)?.as_slice(), Value::from_digits(text)) {
            ([_], Some(value)) => Ok(value),
            (numbers, _) => vector(numbers),
        },
        SocketType::Texture => {
            let color_space = match (node.values.get(&socket.socket), &input.default) {
                (Some(Value::Image(image)), _) => {
                    return Ok(Value::Image(ImageRef { file: text.to_owned(), ..image.clone() }));
                }
                (_, InputDefault::Image(space)) => *space,
                _ => ColorSpace::Srgb,
            };
            Ok(Value::Image(ImageRef {
                file: text.to_owned(),
                color_space,
                wrap_u: Default::default(),
                wrap_v: Default::default(),
                filter: Default::default(),
            }))
        }
        SocketType::Surface => Err("it takes the result of a surface node, which cannot be written".to_owned()),
    }
}

fn plural(count: usize) -> String {
    if count == 1 { "1 number".to_owned() } else { format!("{count} numbers") }
}

fn vector(numbers: &[f32]) -> Result<Value, String> {
    Ok(match *numbers {
        [x] => Value::Number(x),
        [x, y] => Value::Vec2([x, y]),
        [x, y, z] => Value::Vec3([x, y, z]),
        [x, y, z, w] => Value::Vec4([x, y, z, w]),
        _ => return Err(format!("it takes 1 to 4 numbers, and {} were given", numbers.len())),
    })
}

/// A whole number of a range.
pub(crate) fn whole_number<N: TryFrom<u64>>(text: &str, range: std::ops::RangeInclusive<u64>) -> Result<N, String> {
    let wanted = || match (range.start(), range.end()) {
        (0, &u64::MAX) => "write a whole number from 0".to_owned(),
        (least, most) => format!("write a whole number from {least} to {most}"),
    };
    let number: u64 = text.trim().parse().map_err(|_| wanted())?;
    if !range.contains(&number) {
        return Err(wanted());
    }
    number.try_into().map_err(|_| wanted())
}

/// Finite numbers separated by commas.
pub(crate) fn numbers(text: &str) -> Result<Vec<f32>, String> {
    text.split(',')
        .map(|part| match part.trim().parse::<f32>() {
            Ok(number) if number.is_finite() => Ok(number),
            Ok(_) => Err(format!("`{}` is not finite", part.trim())),
            Err(_) => Err(format!("`{}` is not a number", part.trim())),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use halfvector_graph::document::Parameter;

    #[test]
    fn whole_numbers_are_asked_for_in_words() {
        assert_eq!(whole_number("16", 1..=64), Ok(16_u32));
        assert_eq!(whole_number(&u64::MAX.to_string(), 0..=u64::MAX), Ok(u64::MAX));
        for wrong in ["-1", "1.5", "abc", "", "0", "65", "1e1", "99999999999999999999"] {
            assert_eq!(whole_number::<u32>(wrong, 1..=64), Err("write a whole number from 1 to 64".to_owned()));
        }
        assert_eq!(whole_number::<u64>("-1", 0..=u64::MAX), Err("write a whole number from 0".to_owned()));
    }

    fn document() -> Document {
        let mut document = Document::with_surface("plain");
        for name in ["base_color", "metallic"] {
            let socket = SocketRef::new("surface", name);
            document.parameters.push(Parameter { name: name.into(), label: None, socket, range: None });
        }
        document
    }

    fn set_text(document: &mut Document, text: &str) -> Result<(), String> {
        set(document, Library::standard(), &parse_assignment(text)?)
    }

    #[test]
    fn values_take_the_type_of_the_socket() {
        let mut document = document();
        set_text(&mut document, "base_color=1, 0.5,0.25").expect("a colour");
        set_text(&mut document, "metallic=1").expect("a number");
        let values = &document.graph.nodes["surface"].values;
        assert_eq!(values["base_color"], Value::Vec3([1.0, 0.5, 0.25]));
        assert_eq!(values["metallic"], Value::Number(1.0));
        set_text(&mut document, "base_color=0.5").expect("a grey");
        assert_eq!(document.graph.nodes["surface"].values["base_color"], Value::Vec3([0.5; 3]));
    }

    /// What no `f32` holds is taken as it is written, or refused; never rounded.
    #[test]
    fn whole_numbers_are_exact() {
        let mut document = document();
        let node = halfvector_graph::document::Node::new("input/integer");
        document.graph.nodes.insert("n".into(), node);
        let socket = SocketRef::new("n", "value");
        document.parameters.push(Parameter { name: "n".into(), label: None, socket, range: None });
        for text in ["n=16777217", "n=16777217.0", "n=1.6777217e7"] {
            set_text(&mut document, text).unwrap_or_else(|e| panic!("{text}: {e}"));
            assert_eq!(document.graph.nodes["n"].values["value"], Value::Integer(16_777_217), "{text}");
        }
        set_text(&mut document, "n=-2147483648").expect("the least");
        for text in ["n=16777217.5", "n=-2147483649", "n=2147483648", "n=0.99999999999", "n=1e-60", "n=nan", "n=1e99"] {
            let error = set_text(&mut document, text).expect_err(text);
            assert!(error.contains("a whole number from -2147483648 to 2147483647"), "{text}: {error}");
        }
    }

    #[test]
    fn errors_say_what_there_is() {
        let mut document = document();
        assert!(set_text(&mut document, "shine=1").expect_err("unknown").contains("it has base_color, metallic"));
        assert!(set_text(&mut document, "metallic=1,2").expect_err("too many").contains("1 number"));
        assert!(set_text(&mut document, "metallic=nan").expect_err("no number").contains("not finite"));
        assert!(set_text(&mut document, "metallic=x").expect_err("no number").contains("not a number"));
        assert!(set_text(&mut document, "metallic").expect_err("no value").contains("PARAMETER=VALUE"));
    }
}
