//! Pages of the repository in Markdown: their code blocks, links, anchors and generated sections.

use crate::program::root;
use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// Folders without pages of this project.
const FOREIGN: [&str; 4] = ["node_modules", "target", "dist", "out"];

/// One page.
#[derive(Clone, Debug)]
pub struct Page {
    /// Path from the repository's root, with `/`.
    pub path: String,
    /// Its text.
    pub text: String,
}

/// A fenced block of code.
#[derive(Clone, Debug)]
pub struct Block {
    /// Line of the opening fence, from 1.
    pub line: usize,
    /// First word of the info string.
    pub language: String,
    /// Reason after `norun:`, for a block that no test runs.
    pub norun: Option<String>,
    /// Place of the body in the page's text, bytes.
    pub body: Range<usize>,
}

/// A part of a page that is the output of a command.
#[derive(Clone, Debug)]
pub struct Section {
    /// The command after `made by`, without the name of the program.
    pub arguments: Vec<String>,
    /// Name after the colon: the form of the output in the page.
    pub form: Option<String>,
    /// Place of the content in the page's text, bytes.
    pub content: Range<usize>,
}

/// All pages of the repository, by path.
///
/// # Errors
/// When a folder or a page cannot be read.
pub fn pages() -> std::io::Result<Vec<Page>> {
    let mut found = Vec::new();
    let mut folders = vec![root().to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder)? {
            let path = entry?.path();
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if name.starts_with('.') || FOREIGN.contains(&name.as_str()) || path.is_symlink() {
                continue;
            }
            if path.is_dir() {
                folders.push(path);
            } else if name.ends_with(".md") {
                let relative = path.strip_prefix(root()).unwrap_or(&path);
                let text = std::fs::read_to_string(&path)?;
                found.push(Page { path: relative.to_string_lossy().replace('\\', "/"), text });
            }
        }
    }
    found.sort_by(|a, b| a.path.cmp(&b.path));
    Ok(found)
}

impl Page {
    /// Lines with the place of each in the text, bytes; the line break is not part of a line.
    fn lines(&self) -> impl Iterator<Item = (usize, &str)> {
        self.text.split_inclusive('\n').scan(0, |at, line| {
            let start = *at;
            *at += line.len();
            Some((start, line.trim_end_matches('\n')))
        })
    }

    /// The fenced blocks, from top to bottom.
    pub fn blocks(&self) -> Vec<Block> {
        let mut blocks = Vec::new();
        let mut open: Option<Block> = None;
        for (number, (start, line)) in self.lines().enumerate() {
            let Some(info) = line.strip_prefix("```") else { continue };
            if let Some(mut block) = open.take() {
                block.body.end = start;
                blocks.push(block);
                continue;
            }
            let (language, rest) = info.split_once(' ').unwrap_or((info, ""));
            let norun = rest.strip_prefix("norun:").map(|reason| reason.trim().to_owned());
            let body = start + line.len() + 1..self.text.len();
            open = Some(Block { line: number + 1, language: language.to_owned(), norun, body });
        }
        blocks
    }

    /// The prose: lines outside fenced blocks, with their numbers from 1 and without inline code.
    fn prose(&self) -> Vec<(usize, String)> {
        let mut fenced = false;
        let mut prose = Vec::new();
        for (number, line) in self.text.lines().enumerate() {
            if line.starts_with("```") {
                fenced = !fenced;
            } else if !fenced {
                prose.push((number + 1, line.split('`').step_by(2).collect::<Vec<_>>().join(" ")));
            }
        }
        prose
    }

    /// Targets of the links and pictures, each with its line.
    pub fn links(&self) -> Vec<(usize, String)> {
        let targets = |(number, line): (usize, String)| {
            let ends: Vec<(usize, String)> = line
                .split("](")
                .skip(1)
                .filter_map(|rest| Some((number, rest.split_once(')')?.0.to_owned())))
                .collect();
            ends
        };
        self.prose().into_iter().flat_map(targets).collect()
    }

    /// Anchors of the headings, as the web page of the repository makes them.
    pub fn anchors(&self) -> BTreeSet<String> {
        let mut seen: BTreeMap<String, usize> = BTreeMap::new();
        let mut fenced = false;
        let mut anchors = BTreeSet::new();
        for line in self.text.lines() {
            fenced ^= line.starts_with("```");
            let level = line.bytes().take_while(|byte| *byte == b'#').count();
            if fenced || level == 0 || !line[level..].starts_with(' ') {
                continue;
            }
            let anchor = anchor_of(line[level..].trim());
            let again = seen.entry(anchor.clone()).or_default();
            anchors.insert(if *again == 0 { anchor } else { format!("{anchor}-{again}") });
            *again += 1;
        }
        anchors
    }

    /// The sections that are the output of a command.
    pub fn sections(&self) -> Vec<Section> {
        let mut sections = Vec::new();
        let mut open: Option<Section> = None;
        for (start, line) in self.lines() {
            if let Some(mut section) = open.take() {
                if line == "<!-- end -->" {
                    section.content.end = start;
                    sections.push(section);
                } else {
                    open = Some(section);
                }
                continue;
            }
            let Some((command, rest)) =
                line.strip_prefix("<!-- made by `dragtraffic ").and_then(|rest| rest.split_once('`'))
            else {
                continue;
            };
            let form = rest.strip_prefix(": ").and_then(|rest| rest.strip_suffix(" -->"));
            let arguments = command.split(' ').map(str::to_owned).collect();
            let content = start + line.len() + 1..self.text.len();
            open = Some(Section { arguments, form: form.map(str::to_owned), content });
        }
        sections
    }

    /// Fault of a link of this page among all pages, or `None`.
    pub fn broken(&self, link: &str, pages: &[Self]) -> Option<String> {
        if link.contains("://") || link.starts_with("mailto:") {
            return None;
        }
        let (path, anchor) = link.split_once('#').map_or((link, None), |(path, anchor)| (path, Some(anchor)));
        let base = Path::new(&self.path).parent().unwrap_or(Path::new(""));
        let target = if path.is_empty() { PathBuf::from(&self.path) } else { plain(&base.join(path)) };
        if !root().join(&target).exists() {
            return Some(format!("there is no {}", target.display()));
        }
        let anchor = anchor?;
        let shown = target.to_string_lossy().replace('\\', "/");
        let Some(page) = pages.iter().find(|page| page.path == shown) else {
            return Some(format!("{shown} has no headings"));
        };
        (!page.anchors().contains(anchor)).then(|| format!("{shown} has no heading #{anchor}"))
    }
}

/// A path without `.` and `..`.
fn plain(path: &Path) -> PathBuf {
    let mut out = PathBuf::new();
    for part in path.components() {
        match part {
            std::path::Component::ParentDir => {
                out.pop();
            }
            std::path::Component::CurDir => {}
            other => out.push(other),
        }
    }
    out
}

/// The anchor of a heading: lower case, words joined by hyphens, punctuation left out.
fn anchor_of(heading: &str) -> String {
    let kept = heading.chars().filter(|c| c.is_alphanumeric() || matches!(c, ' ' | '-' | '_'));
    kept.flat_map(char::to_lowercase).map(|c| if c == ' ' { '-' } else { c }).collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a failed test panics")]

    use super::*;

    fn page(text: &str) -> Page {
        Page { path: "docs/page.md".into(), text: text.into() }
    }

    #[test]
    fn blocks_have_language_reason_and_body() {
        let page = page("a\n```sh\necho 1\necho 2\n```\n\n```sh norun: takes hours\ntrain\n```\n");
        let blocks = page.blocks();
        let bodies: Vec<&str> = blocks.iter().map(|block| &page.text[block.body.clone()]).collect();
        assert_eq!(bodies, ["echo 1\necho 2\n", "train\n"]);
        assert_eq!(blocks.iter().map(|block| block.line).collect::<Vec<_>>(), [2, 7]);
        assert_eq!(blocks[1].norun.as_deref(), Some("takes hours"));
        assert_eq!(blocks[0].language, "sh");
    }

    #[test]
    fn links_outside_code_are_found_and_resolved() {
        let page = page(
            "# Near miss\n\n[a](../README.md), [b](#near-miss) `[c](d.md)`\n```text\n[e](f)\n```\n![g](no.png)\n",
        );
        let links: Vec<String> = page.links().into_iter().map(|(_, link)| link).collect();
        assert_eq!(links, ["../README.md", "#near-miss", "no.png"]);
        let all = [page.clone()];
        // The repository has no file `docs/page.md`, so only the given pages can resolve its anchor.
        assert!(page.broken("../README.md", &all).is_none());
        assert!(page.broken("no.png", &all).unwrap().contains("docs/no.png"));
        assert!(page.broken("../README.md#nowhere", &all).is_some());
        assert!(page.broken("https://example.org/#x", &all).is_none());
    }

    #[test]
    fn anchors_are_those_of_the_web_page() {
        let page = page(
            "# The paper's tables\n## Add a command, a template or a figure\n## A\n## A\n```sh\n# no\n```\n",
        );
        let anchors: Vec<String> = page.anchors().into_iter().collect();
        assert_eq!(anchors, ["a", "a-1", "add-a-command-a-template-or-a-figure", "the-papers-tables"]);
    }

    #[test]
    fn sections_name_their_command() {
        let page = page("<!-- made by `dragtraffic domain`: limits -->\n| a |\n<!-- end -->\n");
        let sections = page.sections();
        assert_eq!(sections[0].arguments, ["domain"]);
        assert_eq!(sections[0].form.as_deref(), Some("limits"));
        assert_eq!(&page.text[sections[0].content.clone()], "| a |\n");
    }
}
