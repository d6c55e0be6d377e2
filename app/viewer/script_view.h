// Words of scripts for what the surface looks like, the mirror plane and the selection.
#pragma once

#include "app/viewer/script.h"
#include "app/viewer/session.h"

namespace anvil {

/// Whether the word was one of these. @throws InputError for arguments that are none of its own
bool play_view_word(const ScriptLine& line, Session& session);

/// What scripts can expect of them: selected, hidden, pins, anchors; nothing for other names.
std::optional<std::string> view_value(const std::string& name, const Session& session);

} // namespace anvil
