// ScriptEditor.h - the lab's own protocols: write, check, save, run; the host's reference beside it.
//
// A shipped protocol opens read-only, to be saved as a copy of the lab's own. Closing does not lose unsaved text: the
// editor asks, in place.
//
// Thread-safety: the GUI thread; a check runs on a thread of its own.
#pragma once

#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QObject>
#include <QPushButton>
#include <QTimer>
#include <functional>
#include <optional>
#include <utility>

#include "app/gui/controller/BenchController.h"
#include "app/gui/controller/SideWork.h"
#include "app/gui/runner/CodeEdit.h"
#include "app/gui/runner/FindBar.h"
#include "app/scripting/engine/ProtocolDeclaration.h"

namespace tacto::gui {

// Reads what a script declares, beside the window: a script's top level may take up to a second.

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

class ScriptEditor final : public QDialog {
    Q_OBJECT
public:
    /// `controller` outlives it.
    explicit ScriptEditor(const BenchController& controller, QWidget* parent = nullptr);
    /// Opens the script; a source without text is a new one, from a template. What is unsaved stays, and a sentence
    /// says so.
    void edit(const ProtocolSource& source);
    /// Marks the line and says why.
    void showError(int line, const QString& why);
    [[nodiscard]] CodeEdit& code() { return *code_; }
    [[nodiscard]] bool unsaved() const { return code_->document()->isModified(); }
    /// "bend", "new": the script's name.
    [[nodiscard]] QString scriptName() const;
    /// Saves and closes; asks for a name where the script has none, in place. `then` is called once it is saved, and
    /// forgotten when the operator goes back to the text or the file cannot be written.
    void saveAndLeave(std::function<void()> then = {});
    /// Closes without saving.
    void leave();

signals:
    void saved(const QString& path);
    /// Saved, and wanted in the workspace's form.
    void runRequested(const QString& path);

public slots:
    void reject() override;  ///< Esc and the window's cross: asks first where something is unsaved

protected:
    void keyPressEvent(QKeyEvent* event) override;

private:
    [[nodiscard]] QWidget* buildNaming();
    [[nodiscard]] QWidget* buildLeaving();
    void buildButtons();
    void check();
    void checked(const Result<ProtocolDeclaration>& declaration);
    void save();
    void saveAs(const QString& name);
    void saveTo(const QString& path);
    void look();
    void stay();
    void showTitle();

    const BenchController& controller_;
    ProtocolSource source_;
    CodeEdit* code_;
    FindBar* find_ = nullptr;
    QLabel* message_;
    QWidget* naming_ = nullptr;  // "save as": a name
    QLineEdit* name_ = nullptr;
    QWidget* leaving_ = nullptr;  // "not saved"
    QPushButton* save_ = nullptr;
    QTimer later_;
    QTimer look_;           // at the output, while the search is open
    bool wasLive_ = false;  // at the last look: by the time Esc comes here, it has stopped the output
    bool runWhenSaved_ = false;
    bool leaveWhenSaved_ = false;
    std::function<void()> left_;  // saveAndLeave()'s
    ScriptReading reading_;       // Last: its thread ends first
};

}  // namespace tacto::gui
