//! The time that is written into files: none of the clock's, so that equal cages give equal files.

use crate::error::Failure;

/// The last second of the year 9999.
const LAST_SECOND: u64 = 253_402_300_799;

/// The time that `SOURCE_DATE_EPOCH` says, else the beginning of 1970.
pub(crate) fn from_environment() -> Result<String, Failure> {
    let Some(given) = std::env::var_os("SOURCE_DATE_EPOCH") else { return Ok(iso_8601(0)) };
    let seconds = given.to_str().and_then(|text| text.trim().parse::<u64>().ok());
    match seconds.filter(|&seconds| seconds <= LAST_SECOND) {
        Some(seconds) => Ok(iso_8601(seconds)),
        None => Err(Failure::usage("SOURCE_DATE_EPOCH is not a number of seconds since 1970")),
    }
}

/// Seconds since 1970 as a date and time of UTC.
fn iso_8601(seconds: u64) -> String {
    let (mut days, second) = (seconds / 86_400, seconds % 86_400);
    let is_leap =
        |year: u64| year.is_multiple_of(4) && (!year.is_multiple_of(100) || year.is_multiple_of(400));
    let mut year = 1970;
    while days >= 365 + u64::from(is_leap(year)) {
        days -= 365 + u64::from(is_leap(year));
        year += 1;
    }
    let february = 28 + u64::from(is_leap(year));
    let mut month = 1;
    for length in [31, february, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31] {
        if days < length {
            break;
        }
        days -= length;
        month += 1;
    }
    let (hour, minute, second) = (second / 3600, second / 60 % 60, second % 60);
    format!("{year:04}-{month:02}-{:02}T{hour:02}:{minute:02}:{second:02}", days + 1)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seconds_are_dates() {
        assert_eq!(iso_8601(0), "1970-01-01T00:00:00");
        assert_eq!(iso_8601(951_827_696), "2000-02-29T12:34:56");
        assert_eq!(iso_8601(1_735_689_599), "2024-12-31T23:59:59");
        assert_eq!(iso_8601(LAST_SECOND), "9999-12-31T23:59:59");
    }
}
