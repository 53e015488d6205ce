// PassphraseDialog.h - asks for a study's passphrase: once to open it, twice for a new one. It stays until its owner
// closes it, so a wrong passphrase is typed again in place.
#pragma once

#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <memory>

#include "core/seal/Secret.h"

namespace tacto::gui {

/// A line in which a passphrase is typed. It lies in locked memory (Secret.h); the line itself holds
/// dots, so that no copy of it is in the text, in the undo list or with a screen reader.
/// A paste is taken, since password stores hand over that way; what the clipboard holds is not this line's to wipe.
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

class PassphraseDialog final : public QDialog {
    Q_OBJECT
public:
    enum class Purpose { Open, New };
    PassphraseDialog(Purpose purpose, const QString& study, QWidget* parent);
    /// The typed passphrase; null before.
    [[nodiscard]] std::shared_ptr<const Secret> passphrase() const { return passphrase_; }
    /// The study did not open: says so, wiped, and asks again.
    void refuse(const QString& why);
    /// Cancel. A study that is being made is made, so not meanwhile.
    void reject() override;

signals:
    /// While the passphrase is tried, which takes a second, only Cancel can be pressed.
    void given();
    void givenUp();  ///< cancelled while a study is being opened

private:
    void judge();
    [[nodiscard]] bool mayCancel() const;
    void give();
    const Purpose purpose_;
    PassphraseEdit* first_;
    PassphraseEdit* second_ = nullptr;
    QLabel* trouble_;
    QPushButton* go_;
    QPushButton* cancel_;
    bool looking_ = false;
    std::shared_ptr<const Secret> passphrase_;
};

}  // namespace tacto::gui
