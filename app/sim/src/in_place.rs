//! Copies into memory that is already there: a derived `Clone` makes a new value even in `clone_from`.

/// Implements `Clone` field by field, `clone_from` in the memory each field has; the compiler sees that no field is left out.
macro_rules! clone_in_place {
    ($type:ident { $($field:ident),* $(,)? }) => {
        impl Clone for $type {
            fn clone(&self) -> Self {
                Self { $($field: self.$field.clone()),* }
            }
            fn clone_from(&mut self, source: &Self) {
                $(self.$field.clone_from(&source.$field);)*
            }
        }
    };
}

pub(crate) use clone_in_place;
