//! Groups by words: a column of words is grouped by a number for each word, and the words take the place of the numbers
//! in the few rows of the groups.
//!
//! The columns of words in part files are dictionaries. DataFusion writes each row of such a key out as bytes and
//! compares them; a look-up by the key of the dictionary and a group by a number take a fraction of that. The numbers
//! are dealt as words are met, so they differ from run to run of a query, but no row and no order depends on them:
//! groups come in the order in which they are met, as everywhere in the engine. Absent: keys that are no bare words.

use arrow_array::builder::StringDictionaryBuilder;
use arrow_array::cast::AsArray;
use arrow_array::types::{ArrowDictionaryKeyType, Int8Type, Int32Type, UInt32Type};
use arrow_array::{Array, ArrayRef, DictionaryArray, UInt32Array};
use arrow_schema::DataType;
use datafusion::arrow::datatypes::ArrowNativeType;
use datafusion::common::tree_node::Transformed;
use datafusion::common::{Column, DataFusionError, Result};
use datafusion::logical_expr::logical_plan::{Aggregate, Projection};
use datafusion::logical_expr::{
    ColumnarValue, Expr, ExprSchemable, LogicalPlan, ScalarFunctionArgs, ScalarUDF, ScalarUDFImpl, Signature,
    Volatility,
};
use datafusion::optimizer::optimizer::ApplyOrder;
use datafusion::optimizer::{OptimizerConfig, OptimizerRule};
use std::collections::HashMap;
use std::hash::{Hash, Hasher};
use std::sync::{Arc, Mutex, PoisonError};

/// The words that were met, each with its number.
#[derive(Debug, Default)]
struct Words {
    numbers: HashMap<String, u32>,
    words: Vec<String>,
}

/// The words of an engine, shared by its threads.
#[derive(Debug, Clone, Default)]
struct Shared(Arc<Mutex<Words>>);

impl PartialEq for Shared {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl Eq for Shared {}

impl Hash for Shared {
    fn hash<H: Hasher>(&self, state: &mut H) {
        Arc::as_ptr(&self.0).hash(state);
    }
}

impl Shared {
    /// The numbers of words.
    fn numbers<'a>(&self, words: impl Iterator<Item = Option<&'a str>>) -> Vec<Option<u32>> {
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let mut number = |word: &str| match known.numbers.get(word) {
            Some(number) => *number,
            None => {
                let number = known.words.len() as u32;
                known.words.push(word.to_owned());
                known.numbers.insert(word.to_owned(), number);
                number
            }
        };
        words.map(|word| word.map(&mut number)).collect()
    }
}

/// The rule that groups by the numbers of words.
#[derive(Debug)]
pub struct GroupByCodes {
    words: Shared,
    code: Arc<ScalarUDF>,
}

impl Default for GroupByCodes {
    fn default() -> Self {
        let words = Shared::default();
        let code = Code { words: words.clone(), takes: Signature::any(1, Volatility::Immutable) };
        Self { words, code: Arc::new(ScalarUDF::new_from_impl(code)) }
    }
}

/// Whether a column is one of words, as part files have them.
fn is_of_words(column: &DataType) -> bool {
    let DataType::Dictionary(keys, words) = column else { return false };
    matches!(**keys, DataType::Int8 | DataType::Int32) && **words == DataType::Utf8
}

impl OptimizerRule for GroupByCodes {
    fn name(&self) -> &str {
        "group_by_codes"
    }

    fn apply_order(&self) -> Option<ApplyOrder> {
        Some(ApplyOrder::BottomUp)
    }

    fn rewrite(&self, plan: LogicalPlan, _config: &dyn OptimizerConfig) -> Result<Transformed<LogicalPlan>> {
        let LogicalPlan::Aggregate(aggregate) = &plan else { return Ok(Transformed::no(plan)) };
        if aggregate.group_expr.iter().any(|expr| matches!(expr, Expr::GroupingSet(_))) {
            return Ok(Transformed::no(plan));
        }
        let types = aggregate.group_expr.iter().map(|expr| expr.get_type(aggregate.input.schema()));
        let of_words: Vec<Option<DataType>> =
            types.map(|found| found.map(|found| Some(found).filter(is_of_words))).collect::<Result<_>>()?;
        if of_words.iter().all(Option::is_none) {
            return Ok(Transformed::no(plan));
        }
        Ok(Transformed::yes(self.regrouped(aggregate, &of_words)?))
    }
}

impl GroupByCodes {
    /// The groups by numbers, with the words in their place after it; `of_words` tells the type of each key of words.
    fn regrouped(&self, aggregate: &Aggregate, of_words: &[Option<DataType>]) -> Result<LogicalPlan> {
        let key = |(place, (expr, words)): (usize, (&Expr, &Option<DataType>))| match words {
            Some(_) => self.code.call(vec![expr.clone()]).alias(format!("__code_{place}")),
            None => expr.clone(),
        };
        let keys = aggregate.group_expr.iter().zip(of_words).enumerate().map(key).collect();
        let grouped = Aggregate::try_new(Arc::clone(&aggregate.input), keys, aggregate.aggr_expr.clone())?;
        let after = grouped.schema.iter().zip(aggregate.schema.iter()).enumerate();
        let shown = after.map(|(place, (found, (qualifier, field)))| {
            let column = Expr::Column(Column::from(found));
            match of_words.get(place).cloned().flatten() {
                Some(of) => self.word(of).call(vec![column]).alias_qualified(qualifier.cloned(), field.name()),
                None => column,
            }
        });
        let shown = shown.collect();
        Ok(LogicalPlan::Projection(Projection::try_new(shown, Arc::new(LogicalPlan::Aggregate(grouped)))?))
    }

    fn word(&self, of: DataType) -> ScalarUDF {
        let takes = Signature::any(1, Volatility::Immutable);
        ScalarUDF::new_from_impl(Word { words: self.words.clone(), takes, of })
    }
}

/// From words to their numbers.
#[derive(Debug, PartialEq, Eq, Hash)]
struct Code {
    words: Shared,
    takes: Signature,
}

impl ScalarUDFImpl for Code {
    fn name(&self) -> &str {
        "__code"
    }

    fn signature(&self) -> &Signature {
        &self.takes
    }

    fn return_type(&self, _of: &[DataType]) -> Result<DataType> {
        Ok(DataType::UInt32)
    }

    fn invoke_with_args(&self, args: ScalarFunctionArgs) -> Result<ColumnarValue> {
        let column = the_one(&args)?.to_array(args.number_rows)?;
        let codes = match column.data_type() {
            DataType::Dictionary(keys, _) if **keys == DataType::Int8 => self.codes::<Int8Type>(&column),
            DataType::Dictionary(keys, _) if **keys == DataType::Int32 => self.codes::<Int32Type>(&column),
            other => return Err(DataFusionError::Internal(format!("{other} is no column of words"))),
        };
        Ok(ColumnarValue::Array(Arc::new(codes)))
    }
}

impl Code {
    fn codes<K: ArrowDictionaryKeyType>(&self, column: &ArrayRef) -> UInt32Array {
        let column: &DictionaryArray<K> = column.as_dictionary();
        let numbers = self.words.numbers(column.values().as_string::<i32>().iter());
        // The key of a row without a word may be anything.
        let of = |key: K::Native| numbers.get(key.as_usize()).copied().flatten();
        match numbers.iter().all(Option::is_some) {
            true => column.keys().unary::<_, UInt32Type>(|key| of(key).unwrap_or(0)),
            false => column.keys().unary_opt::<_, UInt32Type>(of),
        }
    }
}

/// From numbers to their words, as a dictionary of the type `of`.
#[derive(Debug, PartialEq, Eq, Hash)]
struct Word {
    words: Shared,
    takes: Signature,
    of: DataType,
}

impl ScalarUDFImpl for Word {
    fn name(&self) -> &str {
        "__word"
    }

    fn signature(&self) -> &Signature {
        &self.takes
    }

    fn return_type(&self, _of: &[DataType]) -> Result<DataType> {
        Ok(self.of.clone())
    }

    fn invoke_with_args(&self, args: ScalarFunctionArgs) -> Result<ColumnarValue> {
        let column = the_one(&args)?.to_array(args.number_rows)?;
        let numbers: &UInt32Array = column.as_primitive();
        let words: ArrayRef = match &self.of {
            DataType::Dictionary(keys, _) if **keys == DataType::Int8 => Arc::new(self.words::<Int8Type>(numbers)?),
            _ => Arc::new(self.words::<Int32Type>(numbers)?),
        };
        Ok(ColumnarValue::Array(words))
    }
}

impl Word {
    fn words<K: ArrowDictionaryKeyType>(&self, numbers: &UInt32Array) -> Result<DictionaryArray<K>> {
        let known = self.words.0.lock().unwrap_or_else(PoisonError::into_inner);
        let mut words = StringDictionaryBuilder::<K>::new();
        for number in numbers {
            match number.and_then(|number| known.words.get(number as usize)) {
                Some(word) => _ = words.append(word)?,
                None => words.append_null(),
            }
        }
        Ok(words.finish())
    }
}

/// The one argument of a function.
fn the_one(args: &ScalarFunctionArgs) -> Result<&ColumnarValue> {
    args.args.first().ok_or_else(|| DataFusionError::Internal("one argument is expected".to_owned()))
}
