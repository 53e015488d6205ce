// PassphraseDialog.h - asks for a study's passphrase: once to open a study, twice for a new one, whose strength is
// judged while it is typed. The dialog stays until its owner closes it, so that a wrong passphrase can be typed again.
#pragma once

#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <memory>

#include "core/seal/Secret.h"

namespace tacto::gui {

/// An input line for a passphrase. The passphrase is in locked memory (Secret.h); the line itself holds only dots, so
/// that no copy gets into its text, its undo list or a screen reader. Pasting is allowed, since password managers need
/// it; the clipboard is not wiped here.
class PassphraseEdit final : public QLineEdit {
    Q_OBJECT
public:
    static constexpr std::size_t kMaxBytes = 1024;
    explicit PassphraseEdit(QWidget* parent = nullptr);
    [[nodiscard]] bool isEmpty() const noexcept { return size_ == 0; }
    /// Returns a copy of what was typed.
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
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;

private:
    void add(const QString& text);
    void takeLast();
    void showDots();
    Secret held_;
    std::size_t size_ = 0;
};

class PassphraseDialog final : public QDialog {
    Q_OBJECT
public:
    enum class Purpose { Open, New, Change };
    PassphraseDialog(Purpose purpose, const QString& study, QWidget* parent);
    /// Returns the passphrase once it was typed; null before.
    [[nodiscard]] std::shared_ptr<const Secret> passphrase() const { return passphrase_; }
    /// For Change: whether the passphrase so far was typed as `held`.
    [[nodiscard]] bool knows(const Secret& held) const;
    /// Says that the study did not open, wipes the passphrase and asks again.
    void refuse(const QString& why);
    /// Handles Cancel. A new study cannot be cancelled while it is being created.
    void reject() override;

signals:
    /// The passphrase is being tried, which takes a second; meanwhile only Cancel can be pressed.
    void given();
    void givenUp();  ///< cancelled while a study is being opened

private:
    void judge();
    [[nodiscard]] bool mayCancel() const;
    void give();
    const Purpose purpose_;
    const QString study_;
    PassphraseEdit* soFar_ = nullptr;  ///< only for Change
    PassphraseEdit* first_;
    PassphraseEdit* second_ = nullptr;
    QLabel* trouble_;
    QPushButton* go_;
    QPushButton* cancel_;
    bool looking_ = false;
    std::shared_ptr<const Secret> passphrase_;
};

}  // namespace tacto::gui
