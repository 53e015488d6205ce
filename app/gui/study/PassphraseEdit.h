// PassphraseEdit.h - a line in which a passphrase is typed. It lies in locked memory (Secret.h); the line itself holds
// dots, so that no copy of it is in the text, in the undo list or with a screen reader.
//
// A paste is taken, since password stores hand over that way; what the clipboard holds is not this line's to wipe.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QLineEdit>

#include "core/seal/Secret.h"

namespace tacto::gui {

class PassphraseEdit final : public QLineEdit {
    Q_OBJECT
public:
    static constexpr std::size_t kMaxBytes = 1024;
    explicit PassphraseEdit(QWidget* parent = nullptr);
    [[nodiscard]] bool isEmpty() const noexcept { return size_ == 0; }
    /// A copy of what was typed.
    [[nodiscard]] Secret typed() const;
    [[nodiscard]] bool equals(const PassphraseEdit& other) const noexcept;
    void wipe();

signals:
    void edited();

protected:
    bool event(QEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void inputMethodEvent(QInputMethodEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;

private:
    void add(const QString& text);
    void takeLast();
    void showDots();
    Secret held_;
    std::size_t size_ = 0;
};

}  // namespace tacto::gui
