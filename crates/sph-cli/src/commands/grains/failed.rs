//! A failed run of grains in a few lines.

use dem_scene::DemError;

use crate::number;

/// What happened, to whom, and where to look.
pub fn text(error: &DemError) -> String {
    let mut text = format!("error: {error}\n");
    if let DemError::Failed(failure) = error {
        if let (Some(grain), Some(at)) = (failure.grain, failure.position) {
            let at = at.map(number::plain).join(", ");
            text.push_str(&format!("grain {grain} at ({at}) m\n"));
        }
        text.push_str(
            "bad_state.vtu and bad_state.png show all grains as they were, the one at fault ringed\n\
             the last checkpoint stands: try --resume --changed with a smaller run.safety\n",
        );
    }
    text
}
