//! Setting the parameters that a material offers, by name. Whether the result is sound is for the document's check.

use halfvector_graph::document::Document;
use halfvector_graph::value::Value;

/// Why a parameter was not set.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum ParameterError {
    /// No such parameter.
    #[error("the material `{material}` has no parameter `{name}`; {known}")]
    Unknown {
        /// The material's name.
        material: String,
        /// As given.
        name: String,
        /// What there is.
        known: String,
    },
    /// Too many or too few numbers.
    #[error("the parameter `{name}` takes {wanted}, and {given} were given")]
    Count {
        /// As given.
        name: String,
        /// How many.
        wanted: String,
        /// How many there were.
        given: usize,
    },
    /// NaN or infinity.
    #[error("the parameter `{name}` was given a number that is not finite")]
    NotFinite {
        /// As given.
        name: String,
    },
    /// The parameter of this name stands for a node that is not there.
    #[error("the parameter `{name}` belongs to the node `{node}`, which the material does not have")]
    NoNode {
        /// As given.
        name: String,
        /// The node.
        node: String,
    },
    /// An image is no number.
    #[error("the parameter `{name}` is an image and cannot be set by numbers")]
    Image {
        /// As given.
        name: String,
    },
}

/// Sets a parameter by name. As many numbers as the value has components; one number is spread over a vector; a switch
/// takes 0 or 1.
pub fn set_parameter(document: &mut Document, name: &str, numbers: &[f64]) -> Result<(), ParameterError> {
    let Some(parameter) = document.parameters.iter().find(|p| p.name == name) else {
        let names: Vec<_> = document.parameters.iter().map(|p| p.name.as_str()).collect();
        let known = match names.is_empty() {
            true => "it offers none".to_owned(),
            false => format!("it offers {}", names.join(", ")),
        };
        return Err(ParameterError::Unknown { material: document.name.clone(), name: name.into(), known });
    };
    if numbers.iter().any(|x| !(*x as f32).is_finite()) {
        return Err(ParameterError::NotFinite { name: name.into() });
    }
    let socket = parameter.socket.clone();
    let Some(node) = document.graph.nodes.get_mut(&socket.node) else {
        return Err(ParameterError::NoNode { name: name.into(), node: socket.node });
    };
    let value = match node.values.get(&socket.socket) {
        Some(Value::Image(_)) => return Err(ParameterError::Image { name: name.into() }),
        Some(Value::Bool(_)) => (numbers.len() == 1).then(|| Value::Bool(numbers[0] != 0.0)).ok_or(1),
        Some(value) => {
            let components = value.components().map_or(1, <[_]>::len);
            numbers_as(components, numbers).ok_or(components)
        }
        None => numbers_as(numbers.len(), numbers).ok_or(1),
    };
    let value = value.map_err(|components| ParameterError::Count {
        name: name.into(),
        wanted: match components {
            1 => "1 number".into(),
            n => format!("{n} numbers, or 1 for all of them"),
        },
        given: numbers.len(),
    })?;
    node.values.insert(socket.socket, value);
    Ok(())
}

fn numbers_as(components: usize, numbers: &[f64]) -> Option<Value> {
    if numbers.len() != components && numbers.len() != 1 {
        return None;
    }
    let at = |i: usize| numbers[i % numbers.len()] as f32;
    let whole = numbers.first().and_then(|x| i32::try_from(*x as i64).ok().filter(|i| f64::from(*i) == *x));
    Some(match (components, whole.map(Value::whole)) {
        (1, Some(integer @ Value::Integer(_))) => integer,
        (1, _) => Value::Number(at(0)),
        (2, _) => Value::Vec2([at(0), at(1)]),
        (3, _) => Value::Vec3([at(0), at(1), at(2)]),
        (4, _) => Value::Vec4([at(0), at(1), at(2), at(3)]),
        _ => return None,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn document() -> Document {
        halfvector_graph::file::from_json(
            r#"{"halfvector": 1, "name": "m",
            "nodes": {"surface": {"node": "surface/surface", "values": {"base_color": [1, 1, 1], "metallic": 0}}},
            "links": [], "parameters": [{"name": "base_color", "socket": "surface.base_color"},
            {"name": "metallic", "socket": "surface.metallic"}, {"name": "ior", "socket": "surface.ior"},
            {"name": "lost", "socket": "gone.x"}], "layout": {}}"#,
        )
        .unwrap()
    }

    #[test]
    fn numbers_take_the_shape_of_the_value() {
        let mut document = document();
        set_parameter(&mut document, "base_color", &[0.1, 0.2, 0.3]).unwrap();
        assert_eq!(document.graph.nodes["surface"].values["base_color"], Value::Vec3([0.1, 0.2, 0.3]));
        set_parameter(&mut document, "base_color", &[0.5]).unwrap();
        assert_eq!(document.graph.nodes["surface"].values["base_color"], Value::Vec3([0.5; 3]));
        set_parameter(&mut document, "ior", &[1.4]).unwrap();
        assert_eq!(document.graph.nodes["surface"].values["ior"], Value::Number(1.4));
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let mut document = document();
        let before = document.clone();
        for (name, numbers, reason) in [
            ("metalic", &[1.0][..], "base_color, metallic, ior"),
            ("metallic", &[1.0, 2.0], "takes 1 number, and 2 were given"),
            ("base_color", &[1.0, 2.0], "3 numbers, or 1"),
            ("base_color", &[], "and 0 were given"),
            ("ior", &[], "and 0 were given"),
            ("metallic", &[f64::NAN], "not finite"),
            ("metallic", &[1e39], "not finite"),
            ("lost", &[1.0], "node `gone`"),
        ] {
            let error = set_parameter(&mut document, name, numbers).unwrap_err().to_string();
            assert!(error.contains(reason), "{error}");
        }
        assert_eq!(document, before);
    }
}
