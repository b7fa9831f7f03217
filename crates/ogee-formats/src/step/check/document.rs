//! `Document`: the sections, entities and arguments of a Part 21 file.

use std::collections::HashMap;

use super::lexer::{Lexer, Token};
use super::{Fault, Faults};

/// Lists may stand in lists so deep; no schema needs more than three.
const DEEPEST: usize = 16;

/// An argument.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value<'a> {
    Integer(i64),
    Real(f64),
    Text(&'a [u8]),
    Enumeration(&'a str),
    Reference(u64),
    Unset,
    Derived,
    Binary,
    List(Vec<Value<'a>>),
    /// A value with its type: `LENGTH_MEASURE(25.4)`.
    Typed(Box<Record<'a>>),
}

/// A keyword with its arguments.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Record<'a> {
    pub(super) name: &'a str,
    pub(super) arguments: Vec<Value<'a>>,
}

impl<'a> Record<'a> {
    /// The argument number `i`, from 0.
    pub(super) fn get(&self, i: usize) -> &Value<'a> {
        self.arguments.get(i).unwrap_or(&Value::Unset)
    }
}

/// A numbered entity: one record, or several in a complex one.
#[derive(Clone, Debug)]
pub(super) struct Instance<'a> {
    pub(super) id: u64,
    pub(super) line: usize,
    pub(super) records: Vec<Record<'a>>,
}

impl<'a> Instance<'a> {
    /// The record of that name.
    pub(super) fn record(&self, name: &str) -> Option<&Record<'a>> {
        self.records.iter().find(|record| record.name == name)
    }

    /// What it is called: a complex entity by its first record.
    pub(super) fn name(&self) -> &'a str {
        self.records.first().map_or("", |record| record.name)
    }

    /// A fault of this entity.
    pub(super) fn fault(&self, code: &'static str, message: String) -> Fault {
        Fault { code, message, line: Some(self.line), id: Some(self.id) }
    }
}

/// A file, taken apart.
#[derive(Debug, Default)]
pub(super) struct Document<'a> {
    pub(super) header: Vec<(usize, Record<'a>)>,
    pub(super) instances: Vec<Instance<'a>>,
    index: HashMap<u64, usize>,
}

impl<'a> Document<'a> {
    /// The entity of that number, if there is one.
    pub(super) fn get(&self, id: u64) -> Option<&Instance<'a>> {
        self.index.get(&id).map(|&i| &self.instances[i])
    }

    /// The record of that name in the entity that `value` refers to.
    pub(super) fn follow(&self, value: &Value<'a>, name: &str) -> Option<&Record<'a>> {
        match value {
            Value::Reference(id) => self.get(*id)?.record(name),
            _ => None,
        }
    }

    /// Takes a file apart; what cannot be read is reported and left out.
    pub(super) fn parse(text: &'a [u8], faults: &mut Faults) -> Document<'a> {
        let mut parser = Parser { lexer: Lexer::new(text), ahead: None, faults };
        let mut document = Document::default();
        parser.file(&mut document);
        document
    }
}

/// A statement that could not be read: it was reported.
struct Unreadable;

struct Parser<'a, 'f> {
    lexer: Lexer<'a>,
    ahead: Option<Token<'a>>,
    faults: &'f mut Faults,
}

impl<'a> Parser<'a, '_> {
    fn next(&mut self) -> Option<Token<'a>> {
        self.ahead.take().or_else(|| self.lexer.next(self.faults))
    }

    fn peek(&mut self) -> Option<Token<'a>> {
        if self.ahead.is_none() {
            self.ahead = self.lexer.next(self.faults);
        }
        self.ahead
    }

    fn fault(&mut self, code: &'static str, message: impl Into<String>) -> Unreadable {
        self.faults.push(Fault { code, message: message.into(), line: Some(self.lexer.line), id: None });
        Unreadable
    }

    fn expect(&mut self, wanted: Token<'_>, spelling: &str) -> Result<(), Unreadable> {
        match self.peek() {
            Some(found) if found == wanted => {
                self.next();
                Ok(())
            }
            // Garbage has been reported where it was met.
            Some(Token::Garbage) => Err(Unreadable),
            Some(_) => Err(self.fault("syntax", format!("`{spelling}` expected"))),
            None => Err(self.fault("truncated", "the file ends inside a statement")),
        }
    }

    /// Passes over the rest of a statement.
    fn skip_statement(&mut self) {
        while let Some(token) = self.next() {
            if token == Token::Semicolon {
                break;
            }
        }
    }

    fn file(&mut self, document: &mut Document<'a>) {
        if self.next() != Some(Token::Keyword("ISO-10303-21")) {
            self.fault("not_step", "the file does not begin with ISO-10303-21");
            return;
        }
        if self.expect(Token::Semicolon, ";").is_err() {
            self.skip_statement();
        }
        let mut sections = Vec::new();
        loop {
            match self.next() {
                None => {
                    self.fault("missing_end", "the file does not end with END-ISO-10303-21");
                    break;
                }
                Some(Token::Keyword("END-ISO-10303-21")) => {
                    if self.expect(Token::Semicolon, ";").is_ok() && self.peek().is_some() {
                        self.fault("syntax", "text after END-ISO-10303-21");
                    }
                    break;
                }
                Some(Token::Keyword(name @ ("HEADER" | "DATA" | "ANCHOR" | "REFERENCE" | "SIGNATURE"))) => {
                    // A data section may have a name and a schema of its own.
                    if self.peek() != Some(Token::Semicolon) {
                        self.skip_statement();
                    } else {
                        self.next();
                    }
                    sections.push(name);
                    self.section(name, document);
                }
                Some(Token::Garbage) => self.skip_statement(),
                Some(_) => {
                    self.fault("syntax", "a section expected");
                    self.skip_statement();
                }
            }
        }
        for wanted in ["HEADER", "DATA"] {
            if !sections.contains(&wanted) {
                self.fault("missing_section", format!("there is no section {wanted}"));
            }
        }
    }

    /// The statements up to `ENDSEC;`.
    fn section(&mut self, section: &str, document: &mut Document<'a>) {
        loop {
            let read = match self.peek() {
                None => {
                    self.fault("missing_endsec", format!("section {section} does not end with ENDSEC"));
                    return;
                }
                Some(Token::Keyword("ENDSEC")) => {
                    self.next();
                    if self.expect(Token::Semicolon, ";").is_err() {
                        self.skip_statement();
                    }
                    return;
                }
                Some(Token::Keyword("END-ISO-10303-21" | "DATA" | "HEADER")) => {
                    self.fault("missing_endsec", format!("section {section} does not end with ENDSEC"));
                    return;
                }
                _ if section == "HEADER" => self.header_record(document),
                _ if section == "DATA" => self.instance(document),
                _ => Err(Unreadable),
            };
            if read.is_err() {
                self.skip_statement();
            }
        }
    }

    fn header_record(&mut self, document: &mut Document<'a>) -> Result<(), Unreadable> {
        let line = self.lexer.line;
        let record = self.record()?;
        document.header.push((line, record));
        self.expect(Token::Semicolon, ";")
    }

    fn instance(&mut self, document: &mut Document<'a>) -> Result<(), Unreadable> {
        let id = match self.next() {
            Some(Token::Reference(id)) => id,
            Some(Token::Garbage) => return Err(Unreadable),
            _ => return Err(self.fault("syntax", "an entity `#1=..` expected")),
        };
        let line = self.lexer.line;
        self.expect(Token::Equals, "=")?;
        let mut records = Vec::with_capacity(1);
        if self.peek() == Some(Token::Open) {
            self.next();
            while self.peek() != Some(Token::Close) {
                records.push(self.record()?);
            }
            self.next();
        } else {
            records.push(self.record()?);
        }
        let place = document.instances.len();
        if document.index.insert(id, place).is_some() {
            let message = format!("#{id} is defined twice");
            self.faults.push(Fault { code: "duplicate_id", message, line: Some(line), id: Some(id) });
        }
        document.instances.push(Instance { id, line, records });
        self.expect(Token::Semicolon, ";")
    }

    fn record(&mut self) -> Result<Record<'a>, Unreadable> {
        match self.next() {
            Some(Token::Keyword(name)) => Ok(Record { name, arguments: self.list(0)? }),
            Some(Token::Garbage) => Err(Unreadable),
            Some(_) => Err(self.fault("syntax", "the name of an entity expected")),
            None => Err(self.fault("truncated", "the file ends inside a statement")),
        }
    }

    /// Arguments in parentheses.
    fn list(&mut self, depth: usize) -> Result<Vec<Value<'a>>, Unreadable> {
        if depth > DEEPEST {
            return Err(self.fault("syntax", "lists stand too deep in lists"));
        }
        self.expect(Token::Open, "(")?;
        let mut values = Vec::new();
        if self.peek() == Some(Token::Close) {
            self.next();
            return Ok(values);
        }
        loop {
            values.push(self.value(depth)?);
            if self.peek() == Some(Token::Close) {
                self.next();
                return Ok(values);
            }
            self.expect(Token::Comma, ", or )")?;
        }
    }

    fn value(&mut self, depth: usize) -> Result<Value<'a>, Unreadable> {
        if self.peek() == Some(Token::Open) {
            return Ok(Value::List(self.list(depth + 1)?));
        }
        Ok(match self.next() {
            Some(Token::Reference(id)) => Value::Reference(id),
            Some(Token::Integer(number)) => Value::Integer(number),
            Some(Token::Real(number)) => Value::Real(number),
            Some(Token::Text(text)) => Value::Text(text),
            Some(Token::Enumeration(name)) => Value::Enumeration(name),
            Some(Token::Binary) => Value::Binary,
            Some(Token::Unset) => Value::Unset,
            Some(Token::Derived) => Value::Derived,
            Some(Token::Keyword(name)) if self.peek() == Some(Token::Open) => {
                Value::Typed(Box::new(Record { name, arguments: self.list(depth + 1)? }))
            }
            Some(Token::Keyword(name)) if ["nan", "inf"].contains(&name.to_lowercase().as_str()) => {
                return Err(self.fault("bad_real", format!("`{name}` is no number")));
            }
            Some(Token::Garbage) => return Err(Unreadable),
            Some(_) => return Err(self.fault("syntax", "an argument expected")),
            None => return Err(self.fault("truncated", "the file ends inside a statement")),
        })
    }
}
