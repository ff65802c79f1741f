//! Attribute values of a call, by key.

use endline_sdk::{Attribute, AttributeValue, HookError};

/// The values of a call beside what was declared.
#[derive(Clone, Copy)]
pub struct Values<'a> {
    declared: &'a [Attribute],
    given: &'a [AttributeValue],
}

impl<'a> Values<'a> {
    /// Values in the declared order.
    #[must_use]
    pub fn new(declared: &'a [Attribute], given: &'a [AttributeValue]) -> Self {
        Self { declared, given }
    }

    fn find(&self, key: &str) -> Option<&'a AttributeValue> {
        self.given.get(self.declared.iter().position(|attribute| attribute.key == key)?)
    }

    /// A number in the attribute's SI unit.
    ///
    /// # Errors
    /// Where no number was handed over.
    pub fn number(&self, key: &str) -> Result<f64, HookError> {
        let value = self.find(key).and_then(AttributeValue::number);
        value.ok_or_else(|| HookError::new(format!("attribute `{key}`: expected a number")))
    }

    /// A whole number.
    ///
    /// # Errors
    /// Where none was handed over.
    pub fn count(&self, key: &str) -> Result<u32, HookError> {
        let value = self.number(key)?;
        if value.fract() == 0.0 && (0.0..=f64::from(u32::MAX)).contains(&value) {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "looked at in the line before"
            )]
            return Ok(value as u32);
        }
        Err(HookError::new(format!("attribute `{key}`: expected a whole number, got {value}")))
    }

    /// A word.
    ///
    /// # Errors
    /// Where none was handed over.
    pub fn word(&self, key: &str) -> Result<&'a str, HookError> {
        let value = self.find(key).and_then(AttributeValue::choice);
        value.ok_or_else(|| HookError::new(format!("attribute `{key}`: expected one of its words")))
    }

    /// The id of a library item; empty for none.
    ///
    /// # Errors
    /// Where no id was handed over.
    pub fn item(&self, key: &str) -> Result<&'a str, HookError> {
        let value = self.find(key).and_then(AttributeValue::item);
        value.ok_or_else(|| {
            HookError::new(format!("attribute `{key}`: expected the id of a library item"))
        })
    }

    /// The id of a library item that has to be there.
    ///
    /// # Errors
    /// Where it is empty or no id was handed over.
    pub fn needed(&self, key: &str) -> Result<&'a str, HookError> {
        let id = self.item(key)?;
        if id.is_empty() {
            Err(HookError::new(format!("attribute `{key}`: name an item of the library")))
        } else {
            Ok(id)
        }
    }
}
