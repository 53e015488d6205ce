// SigningRow.h - notes in a session who signed its report: a field for the name, and a button.
#pragma once

#include <QLineEdit>
#include <QPushButton>
#include <QWidget>

#include "app/gui/controller/SideWork.h"

namespace tacto::gui {

class SigningRow final : public QWidget {
    Q_OBJECT
public:
    explicit SigningRow(QWidget* parent = nullptr);
    /// Offers to sign this report of this session; an empty report cannot be signed. `by`: the suggested name.
    void offer(const QString& session, const QString& report, const QString& by);
    /// Returns who signed after offer(), and when; empty before that.
    [[nodiscard]] const QString& noted() const { return noted_; }

signals:
    void ended(const QString& what);  ///< noted(), or why it was not

private:
    void sign();
    void judge();
    QLineEdit* signer_;
    QPushButton* sign_;
    QString session_, report_, noted_;
    bool busy_ = false;
    SideWork signing_;
};

}  // namespace tacto::gui
