// PassphraseDialog.h - asks for a study's passphrase: once to open it, twice for a new one. It stays until its owner
// closes it, so a wrong passphrase is typed again in place.
//
// Thread-safety: the GUI thread.
#pragma once

#include <QDialog>
#include <QLabel>
#include <QPushButton>
#include <memory>

#include "app/gui/study/PassphraseEdit.h"

namespace tacto::gui {

class PassphraseDialog final : public QDialog {
    Q_OBJECT
public:
    enum class Purpose { Open, New };
    PassphraseDialog(Purpose purpose, const QString& study, QWidget* parent);
    /// What was typed; null before.
    [[nodiscard]] std::shared_ptr<const Secret> passphrase() const { return passphrase_; }
    /// It did not open: says so, wiped, and asks again.
    void refuse(const QString& why);
    /// Cancel. A study that is being made is made, so not meanwhile.
    void reject() override;

signals:
    /// While it is looked at, which takes a second, nothing but Cancel can be pressed.
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
