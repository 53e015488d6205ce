#include "app/gui/scope/ScopeKeys.h"

#include <QShortcut>

#include "app/gui/scope/ScopeFiles.h"
#include "app/gui/scope/ScopeWorkspace.h"
#include "app/gui/scope/panels/ScopeTools.h"

namespace tacto::gui {

void addScopeKeys(ScopeWorkspace& scope, ScopeTools& tools, ScopeFiles& files) {
    const auto onKey = [&scope](const QKeySequence& key, auto task) {
        auto* shortcut = new QShortcut(key, &scope);
        // The tools may stand in another row than the workspace: its keys are its own wherever the focus is.
        shortcut->setContext(Qt::WindowShortcut);
        QObject::connect(shortcut, &QShortcut::activated, &scope, task);
    };
    onKey(Qt::Key_A, [&scope] { scope.setMode(ScopeMode::Auto); });
    onKey(Qt::Key_N, [&scope] { scope.setMode(ScopeMode::Normal); });
    onKey(Qt::Key_S, [&scope] { scope.setMode(ScopeMode::Single); });
    onKey(Qt::Key_R, [&scope] { scope.running() ? scope.hold() : scope.run(); });
    onKey(Qt::Key_T, [&tools] { tools.toggleTimeCursors(); });
    onKey(Qt::Key_L, [&tools] { tools.toggleLevelCursors(); });
    onKey(Qt::Key_B, [&tools] { tools.toggleBox(); });
    onKey(Qt::Key_D, [&scope] { emit scope.driveWanted(); });
    onKey(QKeySequence::Save, [&scope, &files] {
        if (scope.model().shown()) files.askSavePicture();
    });
    onKey(QKeySequence::Undo, [&scope] { scope.model().undoZoom(); });
}

}  // namespace tacto::gui
