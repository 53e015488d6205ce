// ScriptEditor.h - the lab's own protocols: write, check, save, run; the host's reference beside it.
//
// A shipped protocol opens read-only, to be saved as a copy of the lab's own. What is not saved is not lost by closing:
// the editor asks, in place.
//
// Thread-safety: the GUI thread; a check runs on a thread of its own.
#pragma once

#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTimer>

#include "app/gui/runner/CodeEdit.h"
#include "app/gui/runner/ScriptReading.h"

namespace tacto::gui {

class ScriptEditor final : public QDialog {
    Q_OBJECT
public:
    explicit ScriptEditor(QWidget* parent = nullptr);
    /// Opens the script; a source without text is a new one, from a template. What is unsaved stays, and a sentence
    /// says so.
    void edit(const ProtocolSource& source);
    /// Marks the line and says why.
    void showError(int line, const QString& why);
    [[nodiscard]] CodeEdit& code() { return *code_; }

signals:
    void saved(const QString& path);
    /// Saved, and wanted in the workspace's form.
    void runRequested(const QString& path);

public slots:
    void reject() override;  ///< Esc and the window's cross: asks first where something is unsaved

private:
    [[nodiscard]] QWidget* buildNaming();
    [[nodiscard]] QWidget* buildLeaving();
    void buildButtons();
    void check();
    void checked(const Result<ProtocolDeclaration>& declaration);
    void save();
    void saveAs(const QString& name);
    void saveTo(const QString& path);
    void leave();
    void showTitle();

    ProtocolSource source_;
    CodeEdit* code_;
    QLabel* message_;
    QWidget* naming_ = nullptr;  // "save as": a name
    QLineEdit* name_ = nullptr;
    QWidget* leaving_ = nullptr;  // "not saved"
    QPushButton* save_ = nullptr;
    QTimer later_;
    bool runWhenSaved_ = false;
    bool leaveWhenSaved_ = false;
    ScriptReading reading_;  // Last: its thread ends first
};

}  // namespace tacto::gui
