// ScriptEditor.h - writes, checks, saves and runs the lab's own protocols; the scripting reference is next to the text.
//
// A shipped protocol opens read-only and can be saved as the lab's own copy. Closing does not lose unsaved text: the
// editor asks first, inside its window.
//
// Thread-safety: the GUI thread; scripts are checked on a separate thread.
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

// Reads a script's declaration on a separate thread, since a script's top level may take up to a second.

class ScriptReading final : public QObject {
public:
    using Done = std::function<void(const ProtocolSource&, const Result<ProtocolDeclaration>&)>;
    /// `done` is called with the answer of each reading.
    explicit ScriptReading(Done done) : done_(std::move(done)) {}
    /// Reads a source. If another is being read, only the newest source waits, and only its answer is reported.
    void read(const ProtocolSource& source);
    [[nodiscard]] bool busy() const { return busy_; }

private:
    void begin(const ProtocolSource& source);
    const Done done_;
    bool busy_ = false;
    std::optional<ProtocolSource> next_;
    SideWork reading_;
};

/// Returns the line named in a script's error ("file:line: reason"); 0 for none.
[[nodiscard]] int lineOf(const QString& error);

class ScriptEditor final : public QDialog {
    Q_OBJECT
public:
    /// `controller` must outlive this.
    explicit ScriptEditor(const BenchController& controller, QWidget* parent = nullptr);
    /// Opens the script; a source without text becomes a new script from a template. Unsaved text stays open instead,
    /// and a sentence says so.
    void edit(const ProtocolSource& source);
    /// Marks the line and shows the reason.
    void showError(int line, const QString& why);
    [[nodiscard]] CodeEdit& code() { return *code_; }
    [[nodiscard]] bool unsaved() const { return code_->isModified(); }
    /// Returns the script's name: "bend", "new".
    [[nodiscard]] QString scriptName() const;
    /// Saves and closes; if the script has no name, asks for one first. `then` is called after saving, but not if the
    /// operator returns to the text or the file cannot be written.
    void saveAndLeave(std::function<void()> then = {});
    /// Closes without saving.
    void leave();

signals:
    void saved(const QString& path);
    /// The script is saved, and its form is wanted in the workspace.
    void runRequested(const QString& path);

public slots:
    void reject() override;  ///< Esc or the window's close button: asks first if text is unsaved

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
    QWidget* naming_ = nullptr;  // the "save as" row, with a name
    QLineEdit* name_ = nullptr;
    QWidget* leaving_ = nullptr;  // the "not saved" row
    QPushButton* save_ = nullptr;
    QTimer later_;
    QTimer look_;           // checks for output while the search is open
    bool wasLive_ = false;  // output was on at the last check: Esc stops it before the key comes here
    bool runWhenSaved_ = false;
    bool leaveWhenSaved_ = false;
    std::function<void()> left_;  // the action given to saveAndLeave()
    ScriptReading reading_;       // declared last: its thread ends first
};

}  // namespace tacto::gui
