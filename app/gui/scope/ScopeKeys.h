// ScopeKeys.h - the oscilloscope's keys, wherever the focus is in the window while the oscilloscope is visible: R run
// or hold, A auto, N normal, S single, T and L cursors, B box, D drive, Ctrl+S saves the picture, Ctrl+Z goes a zoom
// back. The screen's own are in ScopeGestures.h.
//
// Thread-safety: the GUI thread.
#pragma once

namespace tacto::gui {

class ScopeFiles;
class ScopeTools;
class ScopeWorkspace;

/// The shortcuts are the workspace's and go with it.
void addScopeKeys(ScopeWorkspace& scope, ScopeTools& tools, ScopeFiles& files);

}  // namespace tacto::gui
