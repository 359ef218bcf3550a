//! Wall-clock time as RFC 3339 text in UTC, with milliseconds; and monotonic time.

use jiff::Timestamp;
use std::sync::LazyLock;
use std::time::{Duration, Instant, SystemTime};

/// Time since the first call of this function.
pub fn monotonic() -> Duration {
    static START: LazyLock<Instant> = LazyLock::new(Instant::now);
    START.elapsed()
}

/// Now.
pub fn now() -> String {
    text(SystemTime::now())
}

/// A point in time as text; before 1970, or past the calendar, it is shown as 1970.
pub fn text(time: SystemTime) -> String {
    let known = Timestamp::try_from(time).ok().filter(|time| *time >= Timestamp::UNIX_EPOCH);
    format!("{:.3}", known.unwrap_or(Timestamp::UNIX_EPOCH))
}

#[cfg(test)]
mod tests {
    use super::text;
    use std::time::{Duration, UNIX_EPOCH};

    #[test]
    fn known_moments() {
        let at = |seconds| text(UNIX_EPOCH + Duration::from_secs(seconds));
        assert_eq!(at(0), "1970-01-01T00:00:00.000Z");
        assert_eq!(at(951_782_400), "2000-02-29T00:00:00.000Z");
        assert_eq!(at(1_767_607_200), "2026-01-05T10:00:00.000Z");
        assert_eq!(at(4_107_542_399), "2100-02-28T23:59:59.000Z");
        assert_eq!(text(UNIX_EPOCH - Duration::from_secs(1)), at(0));
    }

    #[test]
    fn milliseconds_are_cut_and_not_rounded() {
        assert_eq!(text(UNIX_EPOCH + Duration::from_nanos(1_999_999_999)), "1970-01-01T00:00:01.999Z");
    }
}
