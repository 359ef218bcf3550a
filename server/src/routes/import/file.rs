//! The files of an upload.

use crate::http::upload::{self, Upload};
use api::import::Companions;
use api::{Code, Problem};
use base::netconvert::companions;
use formats::Source;
use std::sync::Arc;

/// A file to read.
pub(super) struct ImportFile {
    pub(super) file: Arc<dyn Source>,
    /// Name of the file: only a label, nothing is opened by it.
    pub(super) label: Option<String>,
    /// Companion files.
    pub(super) beside: Companions,
}

impl ImportFile {
    /// Uploaded files: one body, or at most `most` parts `file` of a form of this type, each with the parts
    /// `net` and `columns` if the form has them.
    pub(super) fn all(upload: &Arc<Upload>, form: Option<&str>, most: usize) -> Result<Vec<Self>, Problem> {
        let Some(content_type) = form else {
            let beside = companions();
            return Ok(vec![Self { file: Arc::<Upload>::clone(upload), label: None, beside }]);
        };
        let names = [("file", most), ("net", 1), ("columns", 1)];
        let [files, mut net, mut columns] = upload::parts(upload, content_type, names)?;
        if files.is_empty() {
            return Err(Problem::field("/file", Code::InvalidField, "the form needs a part named file"));
        }
        let source = |part| Arc::new(part) as Arc<dyn Source>;
        let beside =
            Companions { net: net.pop().map(source), columns: columns.pop().map(source), ..companions() };
        let file = |mut part: upload::FormPart| {
            let label = part.label.take();
            Self { file: source(part), label, beside: beside.clone() }
        };
        Ok(files.into_iter().map(file).collect())
    }
}
