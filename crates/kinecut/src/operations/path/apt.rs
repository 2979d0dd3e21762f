//! Cutter locations in the words of APT (ISO 4343): what CAM systems write for a post-processor.
//!
//! Read are `GOTO`, `FROM`, `GODLTA`, `RAPID`, `FEDRAT`, `UNITS`, `MULTAX`; words that move nothing are passed over; every other
//! word is refused, because it could move the tool.

use glam::DVec3;

use super::path_point::{PathPoint, PointPace};
use crate::base::{Code, FileId, Finding, Result, Sources, Span};

/// Words that move nothing and change no coordinates.
const PASSED_OVER: [&str; 23] = [
    "PARTNO", "PPRINT", "REMARK", "INSERT", "MACHIN", "LOADTL", "TURRET", "SPINDL", "COOLNT", "TLAXIS",
    "CUTTER", "TOOLNO", "TLSPEC", "INTOL", "OUTTOL", "OPSTOP", "STOP", "DELAY", "END", "FINI", "PAINT",
    "CLEARP", "TPRINT",
];
/// Most points of a file.
const MOST_POINTS: usize = 2_000_000;

/// Reads a file of cutter locations.
///
/// # Errors
/// `KC0202` for a malformed statement, `KC0201` for a word that could move the tool and is not known, each with its place.
pub(super) fn read(sources: &Sources, id: FileId) -> Result<Vec<PathPoint>> {
    let text = sources.text(id);
    let mut reader = Reader { unit: 1.0, rapid: false, feed: None, axis: None, at: None, points: Vec::new() };
    let mut start = 0;
    let mut statement = String::new();
    let mut from = 0;
    for line in text.split_inclusive('\n') {
        let (begin, end) = (start, start + line.len());
        start = end;
        let content = line.split("$$").next().unwrap_or("").trim();
        if statement.is_empty() {
            from = begin;
        }
        if let Some(part) = content.strip_suffix('$') {
            // The statement goes on in the next line.
            statement.push_str(part);
            continue;
        }
        statement.push_str(content);
        if !statement.is_empty() {
            let span = Span { file: id, start: from as u32, end: (begin + line.trim_end().len()) as u32 };
            reader.statement(&statement).map_err(|f| f.at(sources.locate(span)))?;
        }
        statement.clear();
        if reader.points.len() > MOST_POINTS {
            return Err(Finding::error(Code::NC_SYNTAX, "the file has too many points")
                .bound(MOST_POINTS as f64, "points")
                .into());
        }
    }
    Ok(reader.points)
}

struct Reader {
    unit: f64,
    rapid: bool,
    feed: Option<f64>,
    axis: Option<DVec3>,
    at: Option<DVec3>,
    points: Vec<PathPoint>,
}

impl Reader {
    fn statement(&mut self, text: &str) -> std::result::Result<(), Finding> {
        let (word, values) = text.split_once('/').unwrap_or((text, ""));
        // Texts (PARTNO BLADE) follow their word without a stroke.
        let word = word.split_whitespace().next().unwrap_or("").to_ascii_uppercase();
        let values: Vec<&str> = match values.trim() {
            "" => Vec::new(),
            list => list.split(',').map(str::trim).collect(),
        };
        match word.as_str() {
            "GOTO" | "FROM" => self.point(&values, word == "FROM"),
            "GODLTA" => self.step(&values),
            "RAPID" => {
                self.rapid = true;
                Ok(())
            }
            "FEDRAT" => self.feed(&values),
            "UNITS" => {
                self.unit = match values.first().map(|v| v.to_ascii_uppercase()).as_deref() {
                    Some("MM") => 1.0,
                    Some("INCHES" | "INCH" | "IN") => 25.4,
                    _ => {
                        return Err(
                            syntax("the unit of length is not known").help("write UNITS/MM or UNITS/INCHES")
                        );
                    }
                };
                Ok(())
            }
            "MULTAX" => Ok(()),
            "CUTCOM" if values.iter().all(|v| v.eq_ignore_ascii_case("OFF")) => Ok(()),
            word if PASSED_OVER.contains(&word) => Ok(()),
            word => {
                Err(Finding::error(Code::NC_WORD, format!("`{word}` could move the tool and is not read"))
                    .help("let the CAM system write points (GOTO) instead"))
            }
        }
    }

    fn point(&mut self, values: &[&str], known_only: bool) -> std::result::Result<(), Finding> {
        if values.len() != 3 && values.len() != 6 {
            return Err(syntax("a point has three numbers, or six with a direction")
                .value(values.len() as f64, "numbers"));
        }
        let tip = vector(&values[..3])? * self.unit;
        if values.len() == 6 {
            let axis = vector(&values[3..])?.try_normalize();
            self.axis = Some(axis.ok_or_else(|| syntax("the direction of the tool has no length"))?);
        }
        self.at = Some(tip);
        if !known_only {
            self.push(tip);
        }
        Ok(())
    }

    fn step(&mut self, values: &[&str]) -> std::result::Result<(), Finding> {
        let from = self.at.ok_or_else(|| syntax("a step from a place that is not known"))?;
        let by = match values {
            [z] => DVec3::Z * number(z)?,
            [_, _, _] => vector(values)?,
            _ => return Err(syntax("a step has one number or three").value(values.len() as f64, "numbers")),
        };
        let tip = from + by * self.unit;
        self.at = Some(tip);
        self.push(tip);
        Ok(())
    }

    fn push(&mut self, tip: DVec3) {
        let pace = match (self.rapid, self.feed) {
            (true, _) => PointPace::Rapid,
            (_, Some(feed)) => PointPace::Feed(feed),
            _ => PointPace::OfOperation,
        };
        // RAPID holds for one point.
        self.rapid = false;
        self.points.push(PathPoint { tip, axis: self.axis, pace });
    }

    fn feed(&mut self, values: &[&str]) -> std::result::Result<(), Finding> {
        let word = |v: &&str| v.chars().all(|c| c.is_ascii_alphabetic());
        let unit = values.iter().find(|v| word(v)).map(|v| v.to_ascii_uppercase());
        let per_second = match unit.as_deref() {
            None => self.unit / 60.0,
            Some("MMPM") => 1.0 / 60.0,
            Some("IPM") => 25.4 / 60.0,
            Some(other) => {
                return Err(syntax(&format!("a feed in `{other}` is not read")).help("write MMPM or IPM"));
            }
        };
        let value = values.iter().find(|v| !word(v)).ok_or_else(|| syntax("the feed has no number"))?;
        let feed = number(value)?;
        if !(feed > 0.0) {
            return Err(syntax("a feed must be positive").value(feed, "").bound(0.0, ""));
        }
        self.feed = Some(feed * per_second);
        self.rapid = false;
        Ok(())
    }
}

fn syntax(what: &str) -> Finding {
    Finding::error(Code::NC_SYNTAX, what.to_owned())
}

fn number(text: &str) -> std::result::Result<f64, Finding> {
    let value: f64 = text.parse().map_err(|_| syntax("a number is malformed"))?;
    // Ten metres, as in the job.
    if value.is_finite() && value.abs() <= crate::base::bounded::MAX_LENGTH {
        Ok(value)
    } else {
        Err(syntax("a number is not finite or too large")
            .value(value, "")
            .bound(crate::base::bounded::MAX_LENGTH, ""))
    }
}

fn vector(texts: &[&str]) -> std::result::Result<DVec3, Finding> {
    Ok(DVec3::new(number(texts[0])?, number(texts[1])?, number(texts[2])?))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(text: &str) -> Result<Vec<PathPoint>> {
        let mut sources = Sources::default();
        let id = sources.add("blade.cl", text);
        read(&sources, id)
    }

    #[test]
    fn points_directions_and_speeds_are_read() {
        let text = "PARTNO BLADE\nUNITS/MM\nMULTAX/ON $$ five axes\nFROM/0,0,100\nRAPID\nGOTO/ 1.0, 2.0, $\n 3.0, 0,0,2\n\
                    FEDRAT/ 600.0, MMPM\nGOTO/4,5,6\nGODLTA/-1\nFEDRAT/IPM,10\nGOTO/7,8,9,0.6,0,0.8\nFINI\n";
        let read = points(text).unwrap();
        let tips: Vec<[f64; 3]> = read.iter().map(|p| p.tip.to_array()).collect();
        assert_eq!(tips, [[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [4.0, 5.0, 5.0], [7.0, 8.0, 9.0]]);
        assert_eq!(read[0].pace, PointPace::Rapid);
        assert_eq!(read[1].pace, PointPace::Feed(10.0));
        let PointPace::Feed(feed) = read[3].pace else { panic!("{:?}", read[3]) };
        assert!((feed - 254.0 / 60.0).abs() < 1e-12);
        assert_eq!(read[1].axis, Some(DVec3::Z));
        assert_eq!(read[3].axis, Some(DVec3::new(0.6, 0.0, 0.8)));
        let inches = points("UNITS/INCHES\nFEDRAT/6\nGOTO/1,0,0\n").unwrap();
        let PointPace::Feed(feed) = inches[0].pace else { panic!("{inches:?}") };
        assert!(inches[0].tip.x == 25.4 && (feed - 2.54).abs() < 1e-12);
    }

    #[test]
    fn what_could_move_the_tool_is_refused_with_its_line() {
        for (text, code, line) in [
            ("GOTO/1,2,3\nCIRCLE/0,0,0,0,0,1,5\n", Code::NC_WORD, 2),
            ("GOTO/1,2\n", Code::NC_SYNTAX, 1),
            ("\n\nGOTO/1,2,x\n", Code::NC_SYNTAX, 3),
            ("GOTO/1,2,3,0,0,0\n", Code::NC_SYNTAX, 1),
            ("GODLTA/1\n", Code::NC_SYNTAX, 1),
            ("FEDRAT/0.1,MMPR\n", Code::NC_SYNTAX, 1),
            ("FEDRAT/-5\n", Code::NC_SYNTAX, 1),
            ("UNITS/FEET\n", Code::NC_SYNTAX, 1),
            ("GOTO/nan,0,0\n", Code::NC_SYNTAX, 1),
            ("CUTCOM/LEFT\n", Code::NC_WORD, 1),
        ] {
            let error = points(text).unwrap_err();
            assert_eq!(error.code(), code, "{text}");
            assert_eq!(error.0.place.as_ref().map(|p| p.line), Some(line), "{text}");
        }
    }
}
