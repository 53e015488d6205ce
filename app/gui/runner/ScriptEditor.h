// ScriptEditor.h - the lab's own protocols: write, check, save, run; the host's reference beside it.
//
// A shipped protocol opens read-only, to be saved as a copy of the lab's own.
//
// Thread-safety: the GUI thread; a check runs on a thread of its own.
#pragma once

#include <QDialog>
#include <QLabel>
#include <QPushButton>
#include <QTimer>
#include <atomic>
#include <memory>

#include "app/gui/runner/CodeEdit.h"
#include "app/scripting/ProtocolDeclaration.h"

namespace tacto::gui {

class ScriptEditor final : public QDialog {
    Q_OBJECT
public:
    explicit ScriptEditor(QWidget* parent = nullptr);
    void show(const ProtocolSource& source);
    /// Marks the line and says why.
    void showError(int line, const QString& why);
    [[nodiscard]] CodeEdit& code() { return *code_; }
    [[nodiscard]] QString message() const { return message_->text(); }

signals:
    void saved(const QString& path);
    void runRequested(const QString& path);

private:
    void check();
    void checked(const Result<ProtocolDeclaration>& declaration);
    void save();
    void saveTo(const QString& path);
    void run();

    ProtocolSource source_;
    CodeEdit* code_;
    QLabel* message_;
    QPushButton* save_;
    QPushButton* run_;
    QTimer later_;
    std::shared_ptr<std::atomic<int>> asked_ = std::make_shared<std::atomic<int>>(0);
    bool runWhenSaved_ = false;
};

}  // namespace tacto::gui
