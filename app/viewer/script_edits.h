// Lines of scripts that are about the edit under way and the past ones: what their panels do.
#pragma once

#include "app/viewer/script.h"
#include "app/viewer/session.h"

namespace anvil {

/// `edit ...`, `refine ...`, `path ...` and `curve ...`; false: another word. @throws InputError
bool play_edit_line(const ScriptLine& line, Session& session);

/// A preset's name, one of the person's curves, or a file of one. @throws InputError
ShapeChoice script_shape(const std::string& name);

/// What `expect` asks of the edit under way or the last one; nothing: it asks for something else.
std::optional<std::string> found_of_edit(const std::string& what, const Session& session);

} // namespace anvil
