// All keys, and what they do.
#pragma once

namespace anvil {

/// In the middle of the window, while `open`.
void show_key_help(bool& open);

} // namespace anvil
