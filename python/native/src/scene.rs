//! Scenes, and the operations on them.

use crate::calls::{cancellable, raised, reply, request};
use api::export::{self, FilePart, MotionChoice};
use api::generate::GenerationRun;
use api::import::{Companions, ReadFile, ReadScene, SceneFile};
use api::place::PlaceBody;
use api::score::ScoreRequest;
use api::{Code, GenerateRequest, Problem, Subject};
use batch::search::call::SearchBody;
use batch::search::one_scene::SceneSearch;
use formats::native::{self, MapForm, SceneDoc};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use scene::Scene;
use serde_json::json;
use std::io;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A scene in the form of the engine.
#[pyclass(frozen, name = "Scene", module = "dragtraffic._native")]
pub struct NativeScene {
    /// The scene.
    pub scene: Arc<Scene>,
}

impl NativeScene {
    fn of(scene: Scene) -> Self {
        Self { scene: Arc::new(scene) }
    }
}

/// Scenes of a file: the number to skip, and the greatest number to read.
fn of_file(
    content: &[u8],
    path: &Path,
    window: (usize, usize),
    around: Option<(f64, f64, f64)>,
) -> Result<ReadFile, Problem> {
    let circle = around.map(|(x, y, radius_m)| format!("{x},{y},{radius_m}"));
    let around = circle.as_deref().map(api::import::around).transpose()?;
    let beside = Companions { around, folder: dragtraffic::beside(path, None), ..dragtraffic::companions() };
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    SceneFile::of(&content, None, &name, &beside, window)?.read(&content)
}

/// A scene in the form of Python, with the messages of its reader.
fn opened<'py>(py: Python<'py>, read: ReadScene) -> PyResult<(NativeScene, Bound<'py, PyBytes>)> {
    let warnings = read.warnings.iter().map(|w| json!({"code": w.code, "detail": w.detail}));
    let warnings = reply(py, &warnings.collect::<Vec<_>>())?;
    Ok((NativeScene::of(read.scene), warnings))
}

#[pymethods]
impl NativeScene {
    /// The scene at an index of a file's content, and what the reader changed or left out. `path` is the
    /// location of the file: the name has the ending, and a recorded table may need files beside it. `around`
    /// is the circle of a map to read: x, y and radius.
    #[staticmethod]
    #[pyo3(signature = (content, path, index, around = None))]
    fn read<'py>(
        py: Python<'py>,
        content: &[u8],
        path: PathBuf,
        index: usize,
        around: Option<(f64, f64, f64)>,
    ) -> PyResult<(Self, Bound<'py, PyBytes>)> {
        let read = cancellable(py, |_, _| {
            let read = of_file(content, &path, (index, 1), around)?;
            let none = || Problem::new(Code::NotFound, format!("there is no scene {index} in this file"));
            read.scenes.into_iter().next().ok_or_else(none)
        })?;
        opened(py, read)
    }

    /// The scene at an index of the recordings of a folder, in their order.
    #[staticmethod]
    fn read_folder<'py>(
        py: Python<'py>,
        path: PathBuf,
        index: usize,
    ) -> PyResult<(Self, Bound<'py, PyBytes>)> {
        let read = cancellable(py, |_, _| {
            let unreadable =
                |error: io::Error| Problem::new(Code::NotFound, format!("cannot be read: {error}"));
            let mut left = index;
            for file in dragtraffic::recordings(&path).map_err(unreadable)? {
                let content = std::fs::read(&file).map_err(unreadable)?;
                let mut read = match of_file(&content, &file, (0, left.saturating_add(1)), None) {
                    Ok(read) => read,
                    // A recording that cannot be read counts as one without a scene.
                    Err(problem) if left == 0 => return Err(problem),
                    Err(_) => {
                        left -= 1;
                        continue;
                    }
                };
                let count = read.scenes.len() + read.skipped.len();
                if count <= left {
                    left -= count;
                    continue;
                }
                // The last skipped one is the requested one: return the reason.
                return match read.skipped.pop() {
                    Some((at, problem)) if at == left => Err(problem),
                    _ => read
                        .scenes
                        .pop()
                        .ok_or_else(|| Problem::internal("a scene was counted and is not there")),
                };
            }
            Err(Problem::new(
                Code::NotFound,
                format!("there is no scene {index} in the recordings of this folder"),
            ))
        })?;
        opened(py, read)
    }

    /// The scene of a document.
    #[staticmethod]
    fn of_document(py: Python<'_>, document: &[u8]) -> PyResult<Self> {
        let read = py.detach(|| native::read(document));
        read.map(Self::of).map_err(|error| raised(py, error.into()))
    }

    /// The document.
    fn document<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        let written = py.detach(|| native::write_doc(&SceneDoc::from_scene(&self.scene, MapForm::Inline)));
        PyBytes::new(py, &written)
    }

    /// The scene with the futures of a request, and the other members of the reply.
    fn generate<'py>(&self, py: Python<'py>, body: &[u8]) -> PyResult<(Self, Bound<'py, PyBytes>)> {
        let body: GenerateRequest = request(py, body)?;
        let answered = cancellable(py, |operations, cancel| {
            let subject = Subject::passing(Arc::clone(&self.scene));
            operations.generate(&body, &subject, cancel.clone()).and_then(GenerationRun::answer)
        })?;
        let said = json!({
            "resolved": answered.answer.resolved,
            "warnings": answered.answer.warnings,
            "code": answered.code,
        });
        let mut scene = (*answered.scene).clone();
        scene.generated = Some(answered.head.generated(String::new(), answered.samples));
        Ok((Self::of(scene), reply(py, &said)?))
    }

    /// Why a search ended, and its tries.
    fn search<'py>(&self, py: Python<'py>, body: &[u8]) -> PyResult<Bound<'py, PyBytes>> {
        let body: SearchBody = request(py, body)?;
        let mut tries = Vec::new();
        let ended = cancellable(py, |operations, cancel| {
            let search = SceneSearch::new(&body, Arc::clone(&self.scene), operations.generator.hashes())?;
            search.run(operations, cancel, &mut |of| {
                tries.push(of);
                ControlFlow::Continue(())
            })
        })?;
        reply(py, &json!({"ended": ended, "tries": tries}))
    }

    /// The scene with more road users, and why some of them have no place.
    fn place<'py>(&self, py: Python<'py>, body: &[u8]) -> PyResult<(Self, Bound<'py, PyBytes>)> {
        let body: PlaceBody = request(py, body)?;
        let placement = cancellable(py, |operations, cancel| operations.place(&body, &self.scene, cancel))?;
        let said = json!({
            "unplaced": placement.unplaced.values().sum::<usize>(),
            "reason": placement.reason,
        });
        Ok((Self::of(body.placed(&self.scene, placement)), reply(py, &said)?))
    }

    /// The report on the scene as it is shown.
    fn score<'py>(&self, py: Python<'py>, body: &[u8]) -> PyResult<Bound<'py, PyBytes>> {
        let body: ScoreRequest = request(py, body)?;
        let score = cancellable(py, |operations, _| {
            operations.score(&body, &Subject::passing(Arc::clone(&self.scene)))
        })?;
        reply(py, &score)
    }

    /// A file in another format, and the contents that it cannot hold.
    #[pyo3(signature = (format, sample=None))]
    fn export<'py>(
        &self,
        py: Python<'py>,
        format: &str,
        sample: Option<usize>,
    ) -> PyResult<(Bound<'py, PyBytes>, Bound<'py, PyBytes>)> {
        let written = cancellable(py, |_, _| {
            export::write(&self.scene, format, sample, MotionChoice::default(), FilePart::default())
        })?;
        Ok((PyBytes::new(py, &written.bytes), reply(py, &written.losses)?))
    }
}
