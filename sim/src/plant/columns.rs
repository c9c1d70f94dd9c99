//! Columns of the plant, each declared once: its name, its type, its value in a new entry, and its value where a
//! fragment of the plant is joined to the whole.
//!
//! The structure of arrays, its length, and how entries are added, copied, joined and cleared are all generated from
//! that declaration, so a new column is one line. Absent: columns that most plants leave empty (`rare`), and the
//! meaning of the columns, which is in the files that declare them.

use super::joint::Joint;
use rayon::Scope;
use std::ops::Range;

/// Columns from which a fragment of a plant can be taken and to which it can be joined.
pub(super) trait Columns {
    /// Copies of some of the entries alone.
    fn copied(&self, taken: Range<usize>) -> Self;

    /// Adds the entries `new` of a fragment, each column on any thread that is free.
    fn join_columns<'a>(&'a mut self, more: &'a Self, new: &Range<usize>, joint: &'a Joint, scope: &Scope<'a>);
}

/// Makes a struct of columns from their declarations: `name: Type = value` where entries of a fragment are copied, and
/// `name: Type = value => joined` where they hold handles or component numbers of the fragment, which change in the
/// whole plant. `value` is an expression of the new entry and its component number; `joined` is an expression of the
/// fragment's columns at a place, and of the joint. A list `beside` the columns, with entries of its own, is filled and
/// joined by the file that declares it.
macro_rules! columns {
    (@join $column:expr, $old:expr, $new:expr,) => {
        $column.extend_from_slice(&$old[$new])
    };
    (@join $column:expr, $old:expr, $new:expr, $joined:expr) => {
        $column.extend($new.map($joined))
    };
    ($(#[$meta:meta])* pub struct $name:ident of $entry:ident: $entry_type:ty, numbered $component:ident,
     joined by $joint:ident from $more:ident at $place:ident {
        $($(#[$doc:meta])* $column:ident: $type:ty = $value:expr $(=> $joined:expr)?,)*
    } $(beside $(#[$beside_doc:meta])* $beside:ident: $beside_type:ty)?) => {
        $(#[$meta])*
        #[derive(Debug, Clone, Default, PartialEq)]
        pub struct $name {
            $($(#[$doc])* pub $column: Vec<$type>,)*
            $($(#[$beside_doc])* pub $beside: Vec<$beside_type>,)?
        }

        impl $name {
            /// The number of entries.
            #[inline]
            pub fn len(&self) -> usize {
                self.component.len()
            }

            /// Whether there are no entries.
            pub fn is_empty(&self) -> bool {
                self.component.is_empty()
            }

            /// Adds an entry to every column.
            #[inline]
            fn push_columns(&mut self, $entry: $entry_type, $component: u32) {
                $(self.$column.push($value);)*
            }

            /// Adds many entries, column by column; each has a component number.
            // Columns that are written in another way when many entries are added do not need it.
            #[allow(dead_code, unused_variables)]
            pub(super) fn extend_columns(&mut self, entries: &[$entry_type], components: &[u32]) {
                $(self.$column.extend(entries.iter().zip(components).map(|(&$entry, &$component)| $value));)*
            }

            /// Takes out the entries from a place on.
            #[allow(dead_code)]
            pub(super) fn truncate(&mut self, number: usize) {
                $(self.$column.truncate(number);)*
            }

            /// Empties every column and keeps the memory.
            pub(super) fn clear(&mut self) {
                $(self.$column.clear();)*
                $(self.$beside.clear();)?
            }
        }

        impl $crate::plant::columns::Columns for $name {
            fn copied(&self, taken: std::ops::Range<usize>) -> Self {
                Self { $($column: self.$column[taken.clone()].to_vec(),)* $($beside: Vec::new(),)? }
            }

            fn join_columns<'a>(
                &'a mut self,
                $more: &'a Self,
                new: &std::ops::Range<usize>,
                $joint: &'a $crate::plant::Joint,
                scope: &rayon::Scope<'a>,
            ) {
                $({
                    let (column, new) = (&mut self.$column, new.clone());
                    scope.spawn(move |_| columns!(@join column, $more.$column, new, $(|$place: usize| $joined)?));
                })*
            }
        }
    };
}
pub(super) use columns;
