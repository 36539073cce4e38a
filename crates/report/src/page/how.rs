//! The end of the page: how it is measured, what words mean, why figures are not there.

use std::fmt::Write;

use super::SORT;
use crate::plot::escaped;
use crate::timing::median;
use crate::{Report, words};

/// The last chapter and the end of the page.
pub(super) fn foot(report: &Report, page: &mut String) {
    let device = report.rows.iter().find_map(|row| row.gpu.as_deref()).map_or(String::new(), |name| {
        let spreads: Vec<f64> = report.rows.iter().filter_map(|row| row.gpu_spread).collect();
        format!(
            "<p><b>Device pixel</b> is the time of that shader for one pixel of a square by the timestamps of {}: the shortest of several \
             passes, in the fastest of five sittings; of a picture it is the whole pass's, vertices included, for one sample. The sitting in the middle took {} % longer, in the median of all methods.</p>",
            escaped(name),
            words::number(100.0 * median(spreads))
        )
    });
    let (words, nulls) = (glossary(), nulls(report));
    let _ = write!(
        page,
        "<h2 id=\"how\">How it is measured</h2>\n<section class=\"card\">\n<p><b>Errors</b> are differences from a truth in 64-bit \
         arithmetic: exact equations, converged quadrature or a sum over every texel, as each figure says. The points are the \
         same in every run, so the errors are, too.</p>\n<p><b>Times</b> are of {}. The methods of a figure run in turns, so \
         that a slow moment meets all of them alike, in five sittings with some time between them; what stands is the median of \
         the fastest sitting, because whatever else the machine does only adds. Batches are of 1,024 elements, which stay in the \
         nearest cache, in columns that begin at cache lines. Read times as ratios within a figure: another machine has other \
         nanoseconds.</p>\n<p><b>Instructions</b> are those of \
         the whole fragment stage of one plain shader with the method, in SPIR-V as naga writes it, before a driver optimises it; \
         called functions count where they are called. What a method adds is its difference from another method.</p>{device}\n<p><b>The front</b>: a method \
         is marked when no other on the same inputs is cheaper and at least as accurate. Times within their spread, 20 % at most, count as \
         alike.</p>\n{words}{nulls}<p>The same figures stand in <code>report.json</code> and in one CSV file for each part.</p>\n</section>\n\
         </main>\n<footer>Made by <code>halfvector report</code> on {}.</footer>\n<script>\n{SORT}</script>\n</body>\n</html>\n",
        escaped(&report.machine),
        escaped(&report.date),
    );
}

/// Words that the names of methods and inputs take for known.
fn glossary() -> String {
    const WORDS: [(&str, &str); 14] = [
        (
            "the report's",
            "the form of the report that this project began with; kept beside the better ones, to be measured",
        ),
        ("default", "what is taken when nothing is chosen"),
        (
            "relative, absolute",
            "a relative error is a part of the truth, in %; an absolute one is a difference of quantities that go from 0 to 1",
        ),
        ("rms error", "root of the mean square of the errors over the inputs"),
        ("largest at", "the input of the largest error, by the names of the function's arguments"),
        ("n.v, n.l, n.h, l.h", "cosines between the normal, the directions of view and light, and the half vector"),
        ("roughness, alpha", "perceptual roughness, 0 to 1, and its square, which the equations take"),
        (
            "level",
            "a smaller copy of an environment, blurred for one roughness; a shader mixes the two nearest (trilinear)",
        ),
        ("six levels", "the report's layout of an environment: levels for roughness 0, 0.2, ... 1"),
        ("SH", "spherical harmonics: a few numbers for light from all directions; sh2 has nine"),
        (
            "MikkTSpace",
            "the way of making tangents of a mesh that programs agree on (Mikkelsen 2008), so that normal maps fit",
        ),
        ("BC5", "blocks of two channels that GPUs read packed, one byte a texel"),
        ("FLIP", "how different two pictures look side by side, 0 to 1 (Andersson et al. 2021)"),
        ("ulp", "the distance of neighbouring numbers of a format"),
    ];
    let lines: String = WORDS
        .iter()
        .map(|(word, meaning)| format!("<dt>{}</dt><dd>{}</dd>", escaped(word), escaped(meaning)))
        .collect();
    format!("<p><b>Words</b></p>\n<dl>{lines}</dl>\n")
}

/// Why cells are empty.
fn nulls(report: &Report) -> String {
    if report.nulls.is_empty() {
        return String::new();
    }
    // The terms that share a reason make one line.
    let mut lines: Vec<(&str, Vec<&str>, &str, &str)> = Vec::new();
    for null in &report.nulls {
        let is_same = |line: &&mut (&str, Vec<&str>, &str, &str)| {
            [line.0, line.2, line.3] == [null.part.as_str(), null.figure.as_str(), null.why.as_str()]
        };
        match lines.iter_mut().find(is_same) {
            Some((_, terms, ..)) => terms.push(&null.term),
            None => lines.push((&null.part, vec![&null.term], &null.figure, &null.why)),
        }
    }
    let row = |(part, terms, figure, why): &(&str, Vec<&str>, &str, &str)| {
        format!(
            "<tr><td>{}</td><td>{}</td><td><code>{}</code></td><td>{}</td></tr>\n",
            escaped(part),
            escaped(&terms.join(", ")),
            escaped(figure),
            escaped(why)
        )
    };
    format!(
        "<details><summary>Why figures are not there</summary><div class=\"scroll\"><table><thead><tr><th>part</th><th>terms</th>\
         <th>figure</th><th>why some of its rows have none</th></tr></thead><tbody>\n{}</tbody></table></div></details>\n",
        lines.iter().map(row).collect::<String>()
    )
}
