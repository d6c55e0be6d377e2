// For sanitized builds: leak reports need the code that leaked.
#pragma once

namespace anvil {

/// Under the address sanitizer: no library that is loaded now is ever unloaded. Drivers leave allocations
/// behind, and a report on code that is gone has no names to suppress by. Elsewhere: nothing.
void pin_loaded_libraries();

} // namespace anvil
