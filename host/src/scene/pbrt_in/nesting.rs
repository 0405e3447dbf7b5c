//! What begins and ends: attributes, objects, files in files.

use super::super::error::SceneError;
use super::super::model::Mesh;
use super::super::read_file::read_unpacked;
use super::state::{Loader, Scope};
use super::token::Lexer;
use super::{MAX_BYTES, MAX_FILES, MAX_INCLUDES, MAX_NESTING, REPAIR, resolve, wrong};

impl Loader<'_> {
    /// Keeps the state until `scope` ends.
    pub fn push(&mut self, scope: Scope, lexer: &Lexer<'_>) -> Result<(), SceneError> {
        if self.stack.len() >= MAX_NESTING {
            let problem = format!("attributes are nested more than {MAX_NESTING} times");
            return Err(wrong(
                &lexer.place(),
                problem,
                "end them where they are not needed",
            ));
        }
        self.stack.push((scope, self.graphics.clone()));
        Ok(())
    }

    pub fn pop(&mut self, scope: Scope, lexer: &Lexer<'_>) -> Result<(), SceneError> {
        let Some((_, before)) = self.stack.pop_if(|(top, _)| *top == scope) else {
            let problem = match scope {
                Scope::Attributes => "AttributeEnd without an AttributeBegin that is still open",
                Scope::Transforms => "TransformEnd without a TransformBegin that is still open",
                Scope::Object => "ObjectEnd without an ObjectBegin that is still open",
            };
            return Err(wrong(&lexer.place(), problem, REPAIR));
        };
        if scope == Scope::Transforms {
            self.graphics.ctm = before.ctm;
            self.graphics.is_start_active = before.is_start_active;
        } else {
            self.graphics = before;
        }
        Ok(())
    }

    pub fn begin_object(&mut self, lexer: &mut Lexer<'_>) -> Result<(), SceneError> {
        let name = lexer.string()?;
        if self.object.is_some() {
            let advice = "end the object before the next begins";
            return Err(wrong(&lexer.place(), "ObjectBegin in an object", advice));
        }
        self.push(Scope::Object, lexer)?;
        self.object = Some((name, Vec::new()));
        Ok(())
    }

    pub fn end_object(&mut self, lexer: &Lexer<'_>) -> Result<(), SceneError> {
        self.pop(Scope::Object, lexer)?;
        if let Some((name, primitives)) = self.object.take() {
            self.objects.insert(name.clone(), self.data.meshes.len() as u32);
            self.data.meshes.push(Mesh { name, primitives });
        }
        Ok(())
    }

    pub fn include(&mut self, word: &str, lexer: &mut Lexer<'_>, depth: u32) -> Result<(), SceneError> {
        let name = lexer.string()?;
        let place = lexer.place();
        let Some(path) = resolve(self.folder, &name) else {
            self.note(
                &place,
                "included files are left out, as there is no folder to look in",
            );
            return Ok(());
        };
        if depth >= MAX_INCLUDES {
            let problem = format!("files include each other more than {MAX_INCLUDES} deep");
            return Err(wrong(&place, problem, "look for a file that includes itself"));
        }
        let bytes = read_unpacked(&path).map_err(|error| {
            // The line that asks for the file is what there is to mend.
            wrong(&place, error.to_string(), "mend the path, or put the file there")
        })?;
        self.files += 1;
        self.bytes += bytes.len() as u64;
        if self.files > MAX_FILES || self.bytes > MAX_BYTES {
            let problem = format!("more than {MAX_FILES} files or {MAX_BYTES} bytes are included");
            return Err(wrong(
                &place,
                problem,
                "look for a file that is included again and again",
            ));
        }
        let mut inner = Lexer::new(path.display().to_string().into(), &bytes);
        if word == "Include" {
            return self.file(&mut inner, depth + 1);
        }
        // What an imported file sets ends with it.
        let before = self.graphics.clone();
        self.file(&mut inner, depth + 1)?;
        self.graphics = before;
        Ok(())
    }
}
