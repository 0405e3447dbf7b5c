//! The format of the files: text, read without a library on any platform.
//!
//! Lines that begin with `#` are comments, empty lines mean nothing. `node_format N` and `changes_to_bits N` stand in the
//! head. `table NAME INPUTS OUTPUTS ROWS` begins a table; each of the ROWS lines after it has INPUTS words that go in and
//! OUTPUTS words that must come out, as 8 hexadecimal digits each: the bits of an `f32`, or an integer.

use std::fmt::Write;
use std::path::PathBuf;

/// A table: records of words that go in, with the words that must come out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Table {
    /// The function, array or pass.
    pub name: String,
    /// Comment lines above it: what the columns are.
    pub note: String,
    /// Words of a row that go in.
    pub inputs: usize,
    /// Words of a row that must come out.
    pub outputs: usize,
    /// All rows, inputs before outputs.
    pub words: Vec<u32>,
    /// Line of the first row in the file, from 1.
    pub line: usize,
}

impl Table {
    /// A table of `rows` without outputs, which [`File::answered`] fills in where `outputs` asks for any.
    ///
    /// # Panics
    /// If `rows` is no whole number of rows.
    #[must_use]
    pub fn new(name: &str, note: &str, inputs: usize, outputs: usize, rows: &[u32]) -> Self {
        let whole = if inputs == 0 { 0 } else { rows.len() % inputs };
        assert_eq!(whole, 0, "{name}: rows of {inputs} words");
        let mut words = Vec::new();
        for row in rows.chunks(inputs.max(1)) {
            words.extend_from_slice(row);
            words.extend(std::iter::repeat_n(0, outputs));
        }
        Self {
            name: name.to_owned(),
            note: note.to_owned(),
            inputs,
            outputs,
            words,
            line: 0,
        }
    }

    /// The rows.
    pub fn rows(&self) -> impl Iterator<Item = &[u32]> {
        self.words.chunks_exact(self.inputs + self.outputs)
    }

    /// What goes in, row after row.
    #[must_use]
    pub fn input(&self) -> Vec<u32> {
        self.rows().flat_map(|row| &row[..self.inputs]).copied().collect()
    }

    /// What must come out, row after row.
    #[must_use]
    pub fn output(&self) -> Vec<u32> {
        self.rows().flat_map(|row| &row[self.inputs..]).copied().collect()
    }
}

/// A file of known answers.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct File {
    /// Name without folder and ending.
    pub name: String,
    /// Comment lines at its head.
    pub note: String,
    /// [`lightbvh::node::NODE_FORMAT`] when the answers were written.
    pub node_format: u32,
    /// Entries under "Changes to bits" in the changelog when the answers were written.
    pub changes_to_bits: u32,
    /// The tables in order.
    pub tables: Vec<Table>,
}

impl File {
    /// Where the file of that name lies.
    #[must_use]
    pub fn path(name: &str) -> PathBuf {
        PathBuf::from(env!("CARGO_MANIFEST_DIR")).join(format!("data/known/{name}.txt"))
    }

    /// The file of that name.
    ///
    /// # Panics
    /// With name and line where there is none or it is not well formed.
    #[must_use]
    pub fn read(name: &str) -> Self {
        let path = Self::path(name);
        let text = std::fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        Self::parse(name, &text).unwrap_or_else(|(line, what)| panic!("{name}.txt:{line}: {what}"))
    }

    /// Reads `text`.
    ///
    /// # Errors
    /// The line, from 1, and what is wrong with it.
    pub fn parse(name: &str, text: &str) -> Result<Self, (usize, String)> {
        let mut file = Self {
            name: name.to_owned(),
            note: String::new(),
            node_format: 0,
            changes_to_bits: 0,
            tables: Vec::new(),
        };
        let (mut note, mut missing) = (String::new(), 0);
        for (at, line) in (1..).zip(text.lines()) {
            let fields: Vec<&str> = line.split_whitespace().collect();
            let number = |field: &str| {
                field
                    .parse::<u32>()
                    .map_err(|_| (at, format!("`{field}` is no number")))
            };
            match fields.as_slice() {
                [] => {}
                [first, ..] if first.starts_with('#') => {
                    note.push_str(line.trim_start_matches('#').trim_start());
                    note.push('\n');
                }
                ["node_format", n] => {
                    file.node_format = number(n)?;
                    file.note = std::mem::take(&mut note);
                }
                ["changes_to_bits", n] => file.changes_to_bits = number(n)?,
                ["table", name, inputs, outputs, rows] if missing == 0 => {
                    missing = number(rows)? as usize;
                    file.tables.push(Table {
                        name: (*name).to_owned(),
                        note: std::mem::take(&mut note),
                        inputs: number(inputs)? as usize,
                        outputs: number(outputs)? as usize,
                        words: Vec::new(),
                        line: at + 1,
                    });
                }
                words => {
                    let table = file
                        .tables
                        .last_mut()
                        .filter(|_| missing > 0)
                        .ok_or((at, "a row outside of a table".to_owned()))?;
                    if words.len() != table.inputs + table.outputs {
                        return Err((at, format!("a row of {} words", words.len())));
                    }
                    for word in words {
                        let word = u32::from_str_radix(word, 16);
                        table
                            .words
                            .push(word.map_err(|_| (at, "not hexadecimal".to_owned()))?);
                    }
                    missing -= 1;
                }
            }
        }
        if missing > 0 {
            return Err((text.lines().count(), format!("{missing} rows are missing")));
        }
        Ok(file)
    }

    /// The file as text.
    #[must_use]
    pub fn text(&self) -> String {
        let mut out = String::new();
        let comment = |out: &mut String, note: &str| {
            for line in note.lines() {
                out.push_str(format!("# {line}").trim_end());
                out.push('\n');
            }
        };
        comment(&mut out, &self.note);
        let _ = writeln!(out, "node_format {}", self.node_format);
        let _ = writeln!(out, "changes_to_bits {}", self.changes_to_bits);
        for table in &self.tables {
            out.push('\n');
            comment(&mut out, &table.note);
            let (inputs, outputs, rows) = (table.inputs, table.outputs, table.rows().count());
            let _ = writeln!(out, "table {} {inputs} {outputs} {rows}", table.name);
            for row in table.rows() {
                let words: Vec<String> = row.iter().map(|word| format!("{word:08x}")).collect();
                out.push_str(&words.join(" "));
                out.push('\n');
            }
        }
        out
    }

    /// The table of that name.
    #[must_use]
    pub fn find(&self, name: &str) -> Option<&Table> {
        self.tables.iter().find(|table| table.name == name)
    }

    /// What goes into the table of that name, as records.
    ///
    /// # Panics
    /// If there is none, or its rows are no such records.
    #[must_use]
    pub fn records<T: bytemuck::AnyBitPattern>(&self, name: &str) -> Vec<T> {
        let table = self
            .find(name)
            .unwrap_or_else(|| panic!("{}.txt has no table `{name}`", self.name));
        assert_eq!(
            table.inputs * 4,
            size_of::<T>(),
            "{}.txt: rows of `{name}`",
            self.name
        );
        table
            .rows()
            .map(|row| bytemuck::pod_read_unaligned(bytemuck::cast_slice(&row[..table.inputs])))
            .collect()
    }

    /// The file with other answers.
    ///
    /// # Panics
    /// If `answers` are not those of all tables that have any.
    #[must_use]
    pub fn answered(mut self, answers: &[Answer]) -> Self {
        for table in &mut self.tables {
            let (inputs, outputs) = (table.inputs, table.outputs);
            if outputs == 0 {
                continue;
            }
            let answer = answers
                .iter()
                .find(|a| a.table == table.name)
                .expect("an answer to each table");
            if inputs == 0 {
                table.words = answer.words.clone();
                continue;
            }
            let rows = table.words.chunks_exact_mut(inputs + outputs);
            assert_eq!(
                rows.len() * outputs,
                answer.words.len(),
                "answers to `{}`",
                table.name
            );
            for (row, answer) in rows.zip(answer.words.chunks_exact(outputs)) {
                row[inputs..].copy_from_slice(answer);
            }
        }
        self
    }

    /// Where `answers` differ from what the file says: number of words compared and a line on each difference, the first
    /// sixteen of a table.
    #[must_use]
    pub fn differences(&self, who: &str, answers: &[Answer]) -> (usize, Vec<String>) {
        let (mut compared, mut lines) = (0, Vec::new());
        for table in self.tables.iter().filter(|table| table.outputs > 0) {
            let place = format!("{}.txt, table {}", self.name, table.name);
            let Some(answer) = answers.iter().find(|a| a.table == table.name) else {
                lines.push(format!("{place}: {who} has no answer"));
                continue;
            };
            let known = table.output();
            if known.len() != answer.words.len() {
                lines.push(format!(
                    "{place}: {} words, {who} has {}",
                    known.len(),
                    answer.words.len()
                ));
                continue;
            }
            compared += known.len();
            let differing = known
                .iter()
                .zip(&answer.words)
                .enumerate()
                .filter(|(_, (a, b))| a != b);
            for (i, (known, found)) in differing.take(16) {
                let (row, column) = (i / table.outputs, table.inputs + i % table.outputs);
                lines.push(format!(
                    "{place}, row {row} (line {}), word {column}: the file says {known:08x}, {who} {found:08x}",
                    table.line + row
                ));
            }
        }
        (compared, lines)
    }
}

/// What comes out for a table.
#[derive(Clone, Debug)]
pub struct Answer {
    /// Name of the table.
    pub table: String,
    /// Its outputs, row after row.
    pub words: Vec<u32>,
}

impl Answer {
    /// The answer to `table`.
    #[must_use]
    pub fn new<T: bytemuck::NoUninit>(table: &str, records: &[T]) -> Self {
        Self {
            table: table.to_owned(),
            words: bytemuck::cast_slice(records).to_vec(),
        }
    }
}
