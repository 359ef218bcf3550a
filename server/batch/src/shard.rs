//! Division of the chunks among several processes.

use std::str::FromStr;

/// One of several equal shares of the chunks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BatchShard {
    index: u64,
    count: u64,
}

/// Most processes of one batch.
const MOST: u64 = 100_000;

impl Default for BatchShard {
    /// The share of all chunks.
    fn default() -> Self {
        Self { index: 0, count: 1 }
    }
}

impl FromStr for BatchShard {
    type Err = String;

    /// Parses `I/N`, with I from 0.
    fn from_str(text: &str) -> Result<Self, String> {
        let expected = || "I/N expected, I from 0 to N - 1, such as 0/8".to_owned();
        let (index, count) = text.split_once('/').ok_or_else(expected)?;
        let whole = |text: &str| text.trim().parse().map_err(|_| expected());
        Self::new(whole(index)?, whole(count)?).ok_or_else(expected)
    }
}

impl BatchShard {
    fn new(index: u64, count: u64) -> Option<Self> {
        (index < count && count <= MOST).then_some(Self { index, count })
    }

    /// The share that a cluster assigns to this process, by a Slurm array (`SLURM_ARRAY_TASK_ID`, `_COUNT`,
    /// `_MIN`, `_STEP`) or an Indexed Job of Kubernetes (`JOB_COMPLETION_INDEX` and, set by the job file,
    /// `JOB_COMPLETION_COUNT`). `None` outside both.
    ///
    /// # Errors
    /// One sentence about the variables.
    pub fn of_environment(variable: impl Fn(&str) -> Option<String>) -> Result<Option<Self>, String> {
        let number = |name: &str| match variable(name) {
            None => Ok(None),
            Some(text) => match text.trim().parse::<u64>() {
                Ok(number) => Ok(Some(number)),
                Err(_) => Err(format!("{name}={text}: a whole number from 0 expected")),
            },
        };
        let (index, count, names) = if let Some(id) = number("SLURM_ARRAY_TASK_ID")? {
            let first = number("SLURM_ARRAY_TASK_MIN")?.unwrap_or(0);
            let step = number("SLURM_ARRAY_TASK_STEP")?.unwrap_or(1).max(1);
            let index = id.checked_sub(first).map(|past| past / step);
            (index, number("SLURM_ARRAY_TASK_COUNT")?, ("SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT"))
        } else if let Some(index) = number("JOB_COMPLETION_INDEX")? {
            let count = number("JOB_COMPLETION_COUNT")?;
            (Some(index), count, ("JOB_COMPLETION_INDEX", "JOB_COMPLETION_COUNT"))
        } else {
            return Ok(None);
        };
        let count = count.ok_or_else(|| format!("{} is set and {} is not", names.0, names.1))?;
        let shard = index.and_then(|index| Self::new(index, count));
        shard.map(Some).ok_or_else(|| format!("{} lies outside of {} = {count}", names.0, names.1))
    }

    /// Whether this process works on the chunks of a share.
    pub fn has(self, share: u64) -> bool {
        share % self.count == self.index
    }

    /// The shard as `I/N`.
    pub fn words(self) -> String {
        format!("{}/{}", self.index, self.count)
    }
}

#[cfg(test)]
mod tests {
    use super::BatchShard;

    #[test]
    fn shares_are_read_and_cover_every_chunk_once() {
        let shard = |text: &str| text.parse::<BatchShard>();
        let all: Vec<BatchShard> = ["0/3", "1/3", "2/3"].iter().map(|text| shard(text).unwrap()).collect();
        assert!((0..20).all(|chunk| all.iter().filter(|shard| shard.has(chunk)).count() == 1));
        for bad in ["3/3", "1", "-1/3", "a/b", "0/0", "1/2/3"] {
            assert!(shard(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn clusters_name_the_share() {
        let of = |pairs: &[(&str, &str)]| {
            let given: Vec<(String, String)> =
                pairs.iter().map(|(name, value)| ((*name).to_owned(), (*value).to_owned())).collect();
            BatchShard::of_environment(|name| given.iter().find(|(n, _)| n == name).map(|(_, v)| v.clone()))
        };
        assert_eq!(of(&[]), Ok(None));
        // sbatch --array=1-9:2
        let slurm = [
            ("SLURM_ARRAY_TASK_ID", "5"),
            ("SLURM_ARRAY_TASK_COUNT", "5"),
            ("SLURM_ARRAY_TASK_MIN", "1"),
            ("SLURM_ARRAY_TASK_STEP", "2"),
        ];
        assert_eq!(of(&slurm).unwrap().unwrap().words(), "2/5");
        let job = [("JOB_COMPLETION_INDEX", "2"), ("JOB_COMPLETION_COUNT", "3")];
        assert_eq!(of(&job).unwrap().unwrap().words(), "2/3");
        assert!(of(&job[..1]).unwrap_err().contains("JOB_COMPLETION_COUNT is not"));
        assert!(of(&[("JOB_COMPLETION_INDEX", "3"), job[1]]).unwrap_err().contains("outside"));
        assert!(of(&[("SLURM_ARRAY_TASK_ID", "x")]).unwrap_err().contains("a whole number"));
    }
}
