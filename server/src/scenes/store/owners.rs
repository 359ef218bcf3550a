//! Owners of scenes: who may see and change what, and how much each may store.

use super::StoreError;
use base::limits::Limits;
use rusqlite::Transaction;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Rights of other users than the owner on a scene.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum SceneShare {
    /// No rights: the scene is not found.
    #[default]
    Nobody,
    /// Read it, generate in it and copy it.
    Read,
    /// Also change it; only its owner deletes it.
    Edit,
}

const SHARES: [(&str, SceneShare); 3] =
    [("nobody", SceneShare::Nobody), ("read", SceneShare::Read), ("edit", SceneShare::Edit)];

impl SceneShare {
    /// Stored form.
    pub(super) fn word(self) -> &'static str {
        SHARES.iter().find(|(_, share)| *share == self).map_or("", |(word, _)| word)
    }

    /// From the stored form; an unknown one shares nothing.
    pub(super) fn of(word: &str) -> Self {
        SHARES.iter().find(|(known, _)| *known == word).map_or(Self::Nobody, |(_, share)| *share)
    }
}

/// Owner of a scene; a scene without owner belongs to everyone.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Ownership {
    /// Name of the user.
    pub owner: Option<String>,
    /// What others may do.
    pub shared: SceneShare,
}

/// Sender of a request to the store.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Viewer {
    /// Owner of new scenes.
    name: Option<String>,
    /// Whether it sees and changes everything, and has no quota.
    sees_all: bool,
}

impl Default for Viewer {
    /// The program itself, and everyone on a server without owners.
    fn default() -> Self {
        Self { name: None, sees_all: true }
    }
}

impl Viewer {
    /// A user, or an administrator; without a name, an unknown user.
    pub fn user(name: Option<String>, is_admin: bool) -> Self {
        Self { name, sees_all: is_admin }
    }

    /// Name and right, as query parameters.
    pub(super) fn parts(&self) -> (Option<&str>, bool) {
        (self.name.as_deref(), self.sees_all)
    }

    pub(super) fn owns(&self, of: &Ownership) -> bool {
        self.sees_all || of.owner.is_none() || of.owner == self.name
    }

    pub(super) fn sees(&self, of: &Ownership) -> bool {
        self.owns(of) || of.shared != SceneShare::Nobody
    }

    fn edits(&self, of: &Ownership) -> bool {
        self.owns(of) || of.shared == SceneShare::Edit
    }

    /// Owner of a new scene.
    pub(super) fn owner(&self) -> Option<&str> {
        self.name.as_deref()
    }

    /// Refuses a change of an existing scene; with `as_owner`, a change that only its owner may make.
    ///
    /// # Errors
    /// [`StoreError::MissingScene`] for an invisible scene, [`StoreError::OfAnother`] for a visible one.
    pub(super) fn check(&self, of: &Ownership, as_owner: bool) -> Result<(), StoreError> {
        if !self.sees(of) {
            return Err(StoreError::MissingScene);
        }
        let may = if as_owner { self.owns(of) } else { self.edits(of) };
        may.then_some(()).ok_or_else(|| StoreError::OfAnother(of.owner.clone().unwrap_or_default()))
    }

    /// Refuses to store more for a user than the limits allow. The change adds `grows` bytes, and a scene if
    /// it is new.
    ///
    /// # Errors
    /// [`StoreError::Full`].
    pub(super) fn check_quota(
        &self,
        tx: &Transaction<'_>,
        limits: &Limits,
        (grows, is_new): (u64, bool),
    ) -> Result<(), StoreError> {
        let (Some(name), false) = self.parts() else { return Ok(()) };
        let sql = "SELECT count(*), ifnull(sum(length(body)), 0) FROM scenes WHERE owner = ?1";
        let (scenes, bytes) = tx.query_row(sql, [name], |row| {
            Ok((row.get::<_, i64>(0)?.unsigned_abs(), row.get::<_, i64>(1)?.unsigned_abs()))
        })?;
        if is_new && scenes >= limits.user_scenes {
            return Err(StoreError::Full(format!(
                "{name} has {scenes} scenes; at most {}.",
                limits.user_scenes
            )));
        }
        if grows > 0 && bytes.saturating_add(grows) > limits.user_bytes {
            let most = limits.user_bytes;
            return Err(StoreError::Full(format!(
                "The scenes of {name} take {bytes} bytes; at most {most}."
            )));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::{Ownership, SceneShare, Viewer};

    #[test]
    fn each_share_allows_what_it_says() {
        let scene = |owner: Option<&str>, shared| Ownership { owner: owner.map(Into::into), shared };
        let user = |name: &str| Viewer::user(Some(name.into()), false);
        let may = |viewer: &Viewer, of: &Ownership| [viewer.sees(of), viewer.edits(of), viewer.owns(of)];
        for (shared, others) in [
            (SceneShare::Nobody, [false, false, false]),
            (SceneShare::Read, [true, false, false]),
            (SceneShare::Edit, [true, true, false]),
        ] {
            let of = scene(Some("anna"), shared);
            assert_eq!(may(&user("anna"), &of), [true; 3]);
            assert_eq!(may(&user("maria"), &of), others);
            assert_eq!(may(&Viewer::user(None, false), &of), others, "nobody known");
            assert_eq!(may(&Viewer::user(Some("boss".into()), true), &of), [true; 3]);
            assert_eq!(may(&Viewer::default(), &of), [true; 3]);
            assert_eq!(may(&user("maria"), &scene(None, shared)), [true; 3], "of everybody");
            assert_eq!(SceneShare::of(shared.word()), shared);
        }
        assert_eq!(SceneShare::of("all"), SceneShare::Nobody);
    }
}
