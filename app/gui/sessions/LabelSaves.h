// LabelSaves.h - edits of sessions' labels on their way to the disk: one after the other beside the window, none left
// out, and each reports how it ended.
//
// Thread-safety: the GUI thread; the files are written on a thread of its own.
#pragma once

#include <QObject>
#include <filesystem>
#include <functional>

#include "app/gui/controller/SideWork.h"
#include "core/session/SessionLabels.h"

namespace tacto::gui {

class LabelSaves final : public QObject {
    Q_OBJECT
public:
    using Then = std::function<void(const Result<SessionLabels>&)>;
    explicit LabelSaves(QObject* parent = nullptr);

    /// As saveLabels(); `then` gets what it returns, on the GUI thread.
    void save(const std::filesystem::path& session, const SessionLabels& shown, const SessionLabels& edited, Then then);

private:
    SideWork saves_;  // edits of one session follow each other; its end waits: what was typed is kept
};

}  // namespace tacto::gui
