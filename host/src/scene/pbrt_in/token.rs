//! Words, strings and brackets, each with its line.

use std::rc::Rc;

use super::super::error::SceneError;
use super::super::notes::Place;
use super::{REPAIR, shown, wrong};

/// A piece of a file.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Token {
    /// A directive, a number, `true` or `false`.
    Word(String),
    /// What stands in quotes.
    Quoted(String),
    Open,
    Close,
}

/// The tokens of a file.
pub(super) struct Lexer<'a> {
    file: Rc<str>,
    bytes: &'a [u8],
    at: usize,
    line: u32,
    /// Of the token last given.
    last: u32,
}

impl<'a> Lexer<'a> {
    pub fn new(file: Rc<str>, bytes: &'a [u8]) -> Self {
        Self {
            file,
            bytes,
            at: 0,
            line: 1,
            last: 1,
        }
    }

    /// Where the last token stands.
    pub fn place(&self) -> Place {
        Place {
            file: Rc::clone(&self.file),
            line: self.last,
        }
    }

    fn byte(&self) -> Option<u8> {
        self.bytes.get(self.at).copied()
    }

    fn skip_space(&mut self) {
        while let Some(byte) = self.byte() {
            match byte {
                b'\n' => self.line = self.line.saturating_add(1),
                b'#' => {
                    let rest = &self.bytes[self.at..];
                    self.at += rest.iter().position(|&b| b == b'\n').unwrap_or(rest.len());
                    continue;
                }
                _ if byte.is_ascii_whitespace() => {}
                _ => return,
            }
            self.at += 1;
        }
    }

    /// Whether the next token is a string.
    pub fn is_at_string(&mut self) -> bool {
        self.skip_space();
        self.byte() == Some(b'"')
    }

    /// Whether the next token begins a list.
    pub fn is_at_list(&mut self) -> bool {
        self.skip_space();
        self.byte() == Some(b'[')
    }

    /// Whether there is no token left, or the next looks like a directive.
    pub fn is_at_directive_or_end(&mut self) -> bool {
        self.skip_space();
        self.byte().is_none_or(|byte| byte.is_ascii_uppercase())
    }

    /// The next token, `None` at the end.
    pub fn next(&mut self) -> Result<Option<Token>, SceneError> {
        self.skip_space();
        self.last = self.line;
        let Some(byte) = self.byte() else { return Ok(None) };
        match byte {
            b'[' | b']' => {
                self.at += 1;
                Ok(Some(if byte == b'[' { Token::Open } else { Token::Close }))
            }
            b'"' => self.quoted().map(Some),
            _ => Ok(Some(Token::Word(
                String::from_utf8_lossy(self.word()).into_owned(),
            ))),
        }
    }

    /// The bytes up to what ends a word.
    fn word(&mut self) -> &'a [u8] {
        let rest = &self.bytes[self.at..];
        let ends = |&byte: &u8| byte.is_ascii_whitespace() || matches!(byte, b'"' | b'[' | b']' | b'#');
        let (word, _) = rest.split_at(rest.iter().position(ends).unwrap_or(rest.len()));
        self.at += word.len();
        word
    }

    fn quoted(&mut self) -> Result<Token, SceneError> {
        self.at += 1;
        let mut text = Vec::new();
        while let Some(byte) = self.byte() {
            self.at += 1;
            match byte {
                b'"' => return Ok(Token::Quoted(String::from_utf8_lossy(&text).into_owned())),
                b'\n' => break,
                b'\\' => {
                    let escaped = self.byte().unwrap_or(b'\\');
                    self.at += 1;
                    text.push(match escaped {
                        b'n' => b'\n',
                        b't' => b'\t',
                        b'r' => b'\r',
                        other => other,
                    });
                }
                _ => text.push(byte),
            }
        }
        Err(wrong(&self.place(), "a string does not end on its line", REPAIR))
    }

    /// A list in brackets, or one value: numbers go to `numbers`, the rest to `words`.
    pub fn values(&mut self, numbers: &mut Vec<f64>, words: &mut Vec<String>) -> Result<(), SceneError> {
        let is_list = self.is_at_list();
        if is_list {
            self.next()?;
        }
        loop {
            self.skip_space();
            let is_plain = !matches!(self.byte(), None | Some(b'"' | b'[' | b']'));
            if is_plain {
                self.last = self.line;
                let word = self.word();
                match std::str::from_utf8(word).ok().and_then(|word| word.parse().ok()) {
                    Some(number) => numbers.push(number),
                    None => words.push(String::from_utf8_lossy(word).into_owned()),
                }
            } else {
                match self.next()? {
                    Some(Token::Quoted(text)) => words.push(text),
                    Some(Token::Close) if is_list => return Ok(()),
                    None => {
                        return Err(wrong(
                            &self.place(),
                            "the file ends in a list of values",
                            "the file is truncated; copy it again",
                        ));
                    }
                    _ => {
                        return Err(wrong(
                            &self.place(),
                            "a bracket where a value is expected",
                            REPAIR,
                        ));
                    }
                }
            }
            if !is_list {
                return Ok(());
            }
        }
    }

    /// Exactly `N` numbers, with or without brackets.
    pub fn numbers<const N: usize>(&mut self) -> Result<[f64; N], SceneError> {
        let (mut numbers, mut words) = (Vec::new(), Vec::new());
        let at = self.place();
        if self.is_at_list() {
            self.values(&mut numbers, &mut words)?;
        } else {
            for _ in 0..N {
                self.skip_space();
                if self.byte().is_some() {
                    self.values(&mut numbers, &mut words)?;
                }
            }
        }
        let fitting = <[f64; N]>::try_from(numbers).ok();
        fitting
            .filter(|numbers| words.is_empty() && numbers.iter().all(|x| x.is_finite()))
            .ok_or_else(|| wrong(&at, format!("expected {N} finite numbers"), REPAIR))
    }

    /// A string.
    pub fn string(&mut self) -> Result<String, SceneError> {
        match self.next()? {
            Some(Token::Quoted(text)) => Ok(text),
            // Versions before the fourth allowed brackets around it.
            Some(Token::Open) => {
                let text = self.next()?;
                let close = self.next()?;
                match (text, close) {
                    (Some(Token::Quoted(text)), Some(Token::Close)) => Ok(text),
                    _ => Err(wrong(&self.place(), "expected a string in quotes", REPAIR)),
                }
            }
            Some(Token::Word(word)) => {
                let problem = format!("expected a string in quotes, found `{}`", shown(&word));
                Err(wrong(&self.place(), problem, REPAIR))
            }
            _ => Err(wrong(&self.place(), "expected a string in quotes", REPAIR)),
        }
    }
}
