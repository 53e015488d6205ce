// ScriptReading.h - reads what a script declares, beside the window: a script's top level may take up to a second.
//
// Thread-safety: the GUI thread; the script runs on a thread of this object, which ends with it.
#pragma once

#include <QObject>
#include <functional>
#include <optional>
#include <utility>

#include "app/gui/controller/SideWork.h"
#include "app/scripting/engine/ProtocolDeclaration.h"

namespace tacto::gui {

class ScriptReading final : public QObject {
public:
    using Done = std::function<void(const ProtocolSource&, const Result<ProtocolDeclaration>&)>;
    /// `done` is called with every answer.
    explicit ScriptReading(Done done) : done_(std::move(done)) {}
    /// A source given while another is being read waits; only the newest waits, and only its answer comes.
    void read(const ProtocolSource& source);
    [[nodiscard]] bool busy() const { return busy_; }

private:
    void begin(const ProtocolSource& source);
    const Done done_;
    bool busy_ = false;
    std::optional<ProtocolSource> next_;
    SideWork reading_;
};

/// The line that a script's error names ("file:line: reason"), 0 for none.
[[nodiscard]] int lineOf(const QString& error);

}  // namespace tacto::gui
