//! Columns that grow by little, since their length hardly changes.

/// Makes room for `count` entries. A column that has to grow gets an eighth more than that.
pub(crate) fn make_room<T>(column: &mut Vec<T>, count: usize) {
    if column.capacity() < count {
        column.reserve_exact(count + count / 8 - column.len());
    }
}

/// Gives a column `count` entries.
pub(super) fn fit<T: Copy>(column: &mut Vec<T>, count: usize, value: T) {
    make_room(column, count);
    column.resize(count, value);
}
