#include "app/scripting/child/JsValue.h"

#include <QJSValueIterator>
#include <cmath>

#include "app/scripting/wire/ScriptMessage.h"

namespace tacto {

namespace {

class Reader {
public:
    Result<nlohmann::json> read(const QJSValue& value, int depth = 0) {
        if (value.isUndefined() || value.isNull()) return nlohmann::json();
        if (value.isBool()) return nlohmann::json(value.toBool());
        if (value.isNumber()) return number(value.toNumber());
        if (value.isString()) return nlohmann::json(value.toString().toStdString());
        if (depth >= kMaxScriptDepth) {
            return fail(ErrorCode::InvalidArgument, "a value is nested deeper than {} levels, or contains itself",
                        kMaxScriptDepth);
        }
        if (value.isCallable() || !value.isObject()) {
            return fail(ErrorCode::InvalidArgument, "a function or symbol was given where plain data are expected");
        }
        return value.isArray() ? array(value, depth) : object(value, depth);
    }

private:
    static nlohmann::json number(double x) {
        constexpr double kExact = 9007199254740992.0;
        if (std::abs(x) < kExact && x == std::floor(x)) return static_cast<std::int64_t>(x);
        return x;
    }

    Result<void> count(std::size_t more) {
        elements_ += more;
        if (elements_ <= kMaxValues) return {};
        return fail(ErrorCode::InvalidArgument, "a value has more than {} elements", kMaxValues);
    }

    Result<nlohmann::json> array(const QJSValue& value, int depth) {
        const quint32 length = value.property(QStringLiteral("length")).toUInt();
        if (auto fits = count(length); !fits) return failure(fits);
        nlohmann::json out = nlohmann::json::array();
        for (quint32 i = 0; i < length; ++i) {
            auto element = read(value.property(i), depth + 1);
            if (!element) return element;
            out.push_back(std::move(*element));
        }
        return out;
    }

    Result<nlohmann::json> object(const QJSValue& value, int depth) {
        nlohmann::json out = nlohmann::json::object();
        QJSValueIterator member(value);
        while (member.next()) {
            const QJSValue held = member.value();
            if (held.isUndefined()) continue;
            if (auto fits = count(1); !fits) return failure(fits);
            auto element = read(held, depth + 1);
            if (!element) return element;
            out[member.name().toStdString()] = std::move(*element);
        }
        return out;
    }

    std::size_t elements_ = 0;
};

}  // namespace

Result<nlohmann::json> toJson(const QJSValue& value) { return Reader().read(value); }

QJSValue toJs(QJSEngine& engine, const nlohmann::json& value) {
    switch (value.type()) {
        case nlohmann::json::value_t::boolean:
            return QJSValue(value.get<bool>());
        case nlohmann::json::value_t::number_integer:
        case nlohmann::json::value_t::number_unsigned:
        case nlohmann::json::value_t::number_float: {
            const double x = value.get<double>();
            return std::isnan(x) ? QJSValue(QJSValue::NullValue) : QJSValue(x);
        }
        case nlohmann::json::value_t::string:
            return QJSValue(QString::fromStdString(value.get_ref<const std::string&>()));
        case nlohmann::json::value_t::array: {
            QJSValue out = engine.newArray(static_cast<uint>(value.size()));
            for (std::size_t i = 0; i < value.size(); ++i) {
                out.setProperty(static_cast<quint32>(i), toJs(engine, value[i]));
            }
            return out;
        }
        case nlohmann::json::value_t::object: {
            QJSValue out = engine.newObject();
            for (const auto& [key, member] : value.items()) {
                out.setProperty(QString::fromStdString(key), toJs(engine, member));
            }
            return out;
        }
        default:
            return QJSValue(QJSValue::NullValue);
    }
}

}  // namespace tacto
