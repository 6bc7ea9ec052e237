//! Lists of numbers on the command line.

use std::str::FromStr;

use serde::{Deserialize, Serialize};

/// Numbers that are above zero, such as `4,4.5,5:7:21`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(transparent)]
pub struct Values(pub Vec<f64>);

impl FromStr for Values {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let mut values = Vec::new();
        for item in text.split(',') {
            match item.split(':').collect::<Vec<_>>()[..] {
                [value] => values.push(number(value)?),
                [from, to, count] => {
                    let (from, to) = (number(from)?, number(to)?);
                    let last = count.trim().parse::<u32>().ok().filter(|count| *count > 1);
                    let last = last.ok_or_else(|| {
                        format!("`{count}` in `{item}` is not a count of at least 2")
                    })? - 1;
                    values.extend((0..=last).map(|turn| {
                        let part = f64::from(turn) / f64::from(last);
                        from * (1.0 - part) + to * part
                    }));
                }
                _ => return Err(format!("`{item}` is neither a number nor FROM:TO:COUNT")),
            }
        }
        Ok(Self(values))
    }
}

fn number(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
        _ => Err(format!("`{text}` is not a number above 0")),
    }
}

#[cfg(test)]
mod tests {
    use super::Values;

    #[test]
    fn numbers_and_ranges() {
        let values: Values = "2, 3,4:5:3".parse().unwrap();
        assert_eq!(values.0, [2.0, 3.0, 4.0, 4.5, 5.0]);
        for bad in [
            "", "a", "-1", "0", "inf", "1:2", "1:2:1", "1:2:x", "1:2:3:4",
        ] {
            assert!(bad.parse::<Values>().is_err(), "{bad}");
        }
    }
}
