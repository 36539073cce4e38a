//! Tests of the crate as a whole, one file for each room of it, on a small node library of their own.

mod check;
mod custom;
mod edit;
mod file;
mod group;
mod instance;
mod large;
mod library;
mod mistakes;
mod operation;
mod resolve;

use std::sync::OnceLock;

use proptest::prelude::*;

use crate::document::{
    AlphaMode, Comment, Document, Frame, Graph, Group, GroupInput, GroupOutput, Interface, Link, Node, Parameter, Rect,
    SocketRef, SurfaceSettings,
};
use crate::library::Library;
use crate::value::{ColorSpace, Filter, ImageRef, Type, Value, Wrap};

/// A library file for a generic node.
const MIX: (&str, &str) = (
    "nodes/math/mix.wgsl",
    "//! T = f32 | vec2f | vec3f | vec4f\nalias T = vec3f;\n\n/// Mix\n///\n/// a (1 - t) + b t\n/// @node math/mix   @also lerp, blend\n\
     /// - a: first [0; -inf..inf]\n/// - b: second [1]\n/// - t: weight of b [0.5; 0..1]\n\
     fn node_math_mix(a: T, b: T, t: f32) -> T { return a + (b - a) * t; }\n",
);

/// Library files with one node of each kind.
const FILES: &[(&str, &str)] = &[
    MIX,
    (
        "nodes/vector/basic.wgsl",
        "// a plain comment\n/// Outputs of separate.\nstruct SeparateOutputs {\n    /// first\n    x: f32,\n    // aside\n    /// second\n    /// and last\n    y: f32,\n}\n\
         /// Separate\n///\n/// The components.\n/// @node vector/separate\n/// - v: vector [0,1]\n/// @output x node_vector_separate_x\n\
         fn node_vector_separate(v: vec2f) -> SeparateOutputs { return SeparateOutputs(v.x, v.y); }\n\
         fn node_vector_separate_x(v: vec2f) -> f32 { return v.x; }\n\
         /// Combine\n///\n/// Three numbers as one vector.\n/// @node vector/combine\n/// - x: first [0]\n/// - y: second [0]\n/// - z: third [0]\n\
         fn node_vector_combine(x: f32, y: f32, z: f32) -> vec3f { return vec3f(x, y, z); }\n\
         /// Extend\n///\n/// A fourth component.\n/// @node vector/extend\n/// - v: vector [0.5]\n\
         fn node_vector_extend(v: vec3f) -> vec4f { return vec4f(v, 1.0); }\n\
         /// Select\n///\n/// One of two.\n/// @node vector/select\n/// - a: first [0]\n/// - which: whether a [false]\n/// - n: count [2; 0..8]\n\
         fn node_vector_select(a: f32, which: bool, n: i32) -> f32 { return select(f32(n), a, which); }\n\
         /// Greater\n///\n/// Whether a number is above another.\n/// @node vector/greater\n/// - a: number [0]\n\
         fn node_vector_greater(a: f32) -> bool { return a > 0.5; }\n",
    ),
    (
        "nodes/textures/image.wgsl",
        "/// Outputs of image.\nstruct ImageOutputs {\n    /// red, green, blue\n    color: vec3f,\n    /// all four\n    rgba: vec4f,\n}\n\
         /// Image\n///\n/// A picture.\n/// @node textures/image\n/// - image: which [image srgb]\n/// - uv: where [context uv0]\n/// @vertex node_textures_image_vertex\n\
         fn node_textures_image(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f) -> ImageOutputs { let t = sampled(image, image_sampler, uv); return ImageOutputs(t.rgb, t); }\n\
         fn node_textures_image_vertex(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f) -> ImageOutputs { let t = textureSampleLevel(image, image_sampler, uv, 0.0); return ImageOutputs(t.rgb, t); }\n\
         fn sampled(image: texture_2d<f32>, image_sampler: sampler, uv: vec2f) -> vec4f { return textureSample(image, image_sampler, uv); }\n\
         /// Slope\n///\n/// How much a number changes from pixel to pixel.\n/// @node textures/slope\n/// - a: number [0]\n\
         fn node_textures_slope(a: f32) -> f32 { return fwidth(a); }\n",
    ),
    (
        "nodes/surface/surface.wgsl",
        "/// Surface\nstruct Surface {\n    base_color: vec3f,\n    perceptual_roughness: f32,\n    normal: vec3f,\n    opacity: f32,\n    height: f32,\n}\n\
         /// Surface\n///\n/// The end.\n/// @node surface/surface\n/// - base_color: color [0.8,0.8,0.8; 0..1; color]\n/// - perceptual_roughness: dullness [0.5; 0..1]\n\
         /// - normal: unit [context world_normal]\n/// - opacity: coverage [1; 0..1]\n/// - height: displacement [0; -1..1; m]\n\
         fn node_surface_surface(base_color: vec3f, perceptual_roughness: f32, normal: vec3f, opacity: f32, height: f32) -> Surface { return Surface(base_color, perceptual_roughness, normal, opacity, height); }\n",
    ),
];

/// The library of [`FILES`].
fn small() -> &'static Library {
    static SMALL: OnceLock<Library> = OnceLock::new();
    SMALL.get_or_init(|| Library::parse(FILES).unwrap_or_else(|e| panic!("{e}")))
}

fn socket(written: &str) -> SocketRef {
    SocketRef::parse(written).unwrap_or_else(|| panic!("{written} is no socket"))
}

fn link(from: &str, to: &str) -> Link {
    Link::new(socket(from), socket(to))
}

/// A surface, and nodes and links given as `id` and `kind`, `from` and `to`.
fn document(nodes: &[(&str, &str)], links: &[(&str, &str)]) -> Document {
    let mut document = Document::with_surface("test");
    document.graph.nodes.extend(nodes.iter().map(|(id, kind)| (id.to_string(), Node::new(kind))));
    document.graph.links.extend(links.iter().map(|(from, to)| link(from, to)));
    document
}

/// Any number, also such as no sound document has.
fn any_number() -> impl Strategy<Value = f32> {
    prop_oneof![4 => any::<f32>(), 1 => Just(0.0), 1 => Just(-0.0), 1 => Just(1.0), 1 => Just(f32::NAN), 1 => Just(f32::INFINITY)]
}

/// Ids from a small set, so that things meet.
fn any_id() -> impl Strategy<Value = String> {
    prop_oneof![8 => "[a-e]", 4 => Just("surface".to_string()), 1 => "\\PC{0,2}|a\\.b|9"]
}

fn any_socket() -> impl Strategy<Value = SocketRef> {
    (
        any_id(),
        prop_oneof![Just("a"), Just("b"), Just("x"), Just("out"), Just("base_color"), Just("height"), Just("color")],
    )
        .prop_map(|(node, socket)| SocketRef::new(&node, socket))
}

fn any_link() -> impl Strategy<Value = Link> {
    (any_socket(), any_socket()).prop_map(|(from, to)| Link { from, to })
}

fn any_image() -> impl Strategy<Value = ImageRef> {
    (".{0,6}", any::<[bool; 3]>(), 0..3).prop_map(|(file, [linear, nearest, clamp], wrap)| ImageRef {
        file,
        color_space: if linear { ColorSpace::Linear } else { ColorSpace::Srgb },
        wrap_u: [Wrap::Repeat, Wrap::Clamp, Wrap::Mirror][wrap as usize],
        wrap_v: if clamp { Wrap::Clamp } else { Wrap::Repeat },
        filter: if nearest { Filter::Nearest } else { Filter::Linear },
    })
}

fn any_value() -> impl Strategy<Value = Value> {
    prop_oneof![
        any::<bool>().prop_map(Value::Bool),
        any_number().prop_map(Value::Number),
        any::<i32>().prop_map(Value::whole),
        [any_number(), any_number()].prop_map(Value::Vec2),
        [any_number(), any_number(), any_number()].prop_map(Value::Vec3),
        [any_number(), any_number(), any_number(), any_number()].prop_map(Value::Vec4),
        any_image().prop_map(Value::Image),
    ]
}

fn any_node() -> impl Strategy<Value = Node> {
    let kind = prop_oneof![
        1 => Just("group/g".to_string()),
        3 => (0..8usize).prop_map(|i| small().iter().nth(i).map_or("math/mix".into(), |def| def.id.clone())),
        1 => "[a-z/]{0,8}",
    ];
    let values = prop::collection::btree_map("[a-b]|image|height|.{0,2}", any_value(), 0..3);
    (kind, prop::option::of(".{0,4}"), values).prop_map(|(node, label, values)| Node {
        label,
        values,
        unknown: [("note".to_string(), "kept".into())].into_iter().collect(),
        ..Node::new(&node)
    })
}

fn any_parameter() -> impl Strategy<Value = Parameter> {
    ("[a-c]|.{0,3}", prop::option::of(".{0,3}"), any_socket(), prop::option::of([any_number(), any_number()]))
        .prop_map(|(name, label, socket, range)| Parameter { name, label, socket, range })
}

fn any_settings() -> impl Strategy<Value = SurfaceSettings> {
    (0..3usize, any_number(), any::<bool>(), any::<bool>()).prop_map(
        |(mode, alpha_cutoff, double_sided, thin_walled)| SurfaceSettings {
            alpha_mode: [AlphaMode::Opaque, AlphaMode::Mask, AlphaMode::Blend][mode],
            alpha_cutoff,
            double_sided,
            thin_walled,
        },
    )
}

fn any_rect() -> impl Strategy<Value = Rect> {
    [any_number(), any_number(), any_number(), any_number()]
        .prop_map(|[x, y, width, height]| Rect { position: [x, y], size: [width, height] })
}

fn any_frame() -> impl Strategy<Value = Frame> {
    (".{0,3}", prop::option::of(any::<[u8; 3]>()), any_rect()).prop_map(|(title, color, rect)| Frame {
        title,
        color,
        rect,
        ..Frame::default()
    })
}

fn any_comment() -> impl Strategy<Value = Comment> {
    (".{0,3}|a\nb", any_rect()).prop_map(|(text, rect)| Comment { text, rect, ..Comment::default() })
}

/// Any graph, sound or not.
fn any_graph() -> impl Strategy<Value = Graph> {
    (
        prop::collection::btree_map(any_id(), any_node(), 0..6),
        prop::collection::vec(any_link(), 0..8),
        prop::collection::btree_map(any_id(), [any_number(), any_number()], 0..3),
        prop::collection::btree_map("[ab]", any_frame(), 0..2),
        prop::collection::btree_map("[ab]", any_comment(), 0..2),
    )
        .prop_map(|(nodes, links, layout, frames, comments)| Graph {
            nodes,
            links,
            layout,
            frames,
            comments,
            ..Graph::default()
        })
}

fn any_interface() -> impl Strategy<Value = Interface> {
    let ty = || prop::sample::select(&[Type::F32, Type::Vec3, Type::Bool][..]);
    let input = (any_id(), ty(), any_value(), prop::option::of(".{0,2}"))
        .prop_map(|(name, ty, value, label)| GroupInput { label, ..GroupInput::new(&name, ty, value) });
    let output = (any_id(), ty()).prop_map(|(name, ty)| GroupOutput::new(&name, ty));
    (".{0,3}", prop::collection::vec(input, 0..3), prop::collection::vec(output, 0..3))
        .prop_map(|(label, inputs, outputs)| Interface { label, inputs, outputs, help: String::new() })
}

fn any_group() -> impl Strategy<Value = Group> {
    (any_interface(), any_graph()).prop_map(|(interface, graph)| Group { interface, graph, ..Group::default() })
}

/// Any document, sound or not.
fn any_document() -> impl Strategy<Value = Document> {
    (
        ".{0,5}",
        any_graph(),
        prop::collection::vec(any_parameter(), 0..4),
        any_settings(),
        prop::collection::btree_map("[gh]", any_group(), 0..2),
        prop::collection::btree_map("[st]", ".{0,3}|a\nb\n", 0..2),
    )
        .prop_map(|(name, graph, parameters, surface, groups, functions)| Document {
            functions,
            graph,
            parameters,
            surface,
            groups,
            ..Document::new(&name)
        })
}
