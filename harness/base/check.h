// Checks of what only a programmer can get wrong, with the values. They run in every build; those with D in
// their name, for hot loops, only in builds with assertions (no NDEBUG).
//
//   ML_CHECK(tree.is_sorted());
//   ML_CHECK_LT(index, count);     "froxels.cpp:45: index < count does not hold: 12 and 8"
//
// What a user, a file or a device does wrong is a UsageError or SystemError (error.h).
#pragma once

#include <fmt/format.h>

#include <concepts>
#include <string>
#include <utility>

namespace ml {

// Throws std::logic_error: "FILE:LINE: CONDITION does not hold", and the values where there are any.
[[noreturn]] void check_failed(const char* file, int line, const char* condition, const std::string& values);

namespace check_detail {

template <typename T>
concept Integer = std::integral<T> && !std::same_as<T, bool> && !std::same_as<T, char>;

template <typename T>
std::string text(const T& value) {
  if constexpr (fmt::is_formattable<T>::value)
    return fmt::format("{}", value);
  else
    return "?";
}

template <typename A, typename B>
[[noreturn, gnu::cold, gnu::noinline]] void failed(const char* file, int line, const char* condition,
                                                   const A& a, const B& b) {
  check_failed(file, line, condition, text(a) + " and " + text(b));
}

// Integers are compared by their values, whatever their signs.
template <typename A, typename B>
constexpr bool less(const A& a, const B& b) {
  if constexpr (Integer<A> && Integer<B>)
    return std::cmp_less(a, b);
  else
    return a < b;
}
template <typename A, typename B>
constexpr bool equal(const A& a, const B& b) {
  if constexpr (Integer<A> && Integer<B>)
    return std::cmp_equal(a, b);
  else
    return a == b;
}

}  // namespace check_detail
}  // namespace ml

#define ML_CHECK(condition) \
  (static_cast<bool>(condition) ? void() : ::ml::check_failed(__FILE__, __LINE__, #condition, ""))

#define ML_CHECK_THAT(holds, a, op, b)                                                                 \
  do {                                                                                                 \
    const auto& check_a = (a);                                                                         \
    const auto& check_b = (b);                                                                         \
    if (!(holds)) ::ml::check_detail::failed(__FILE__, __LINE__, #a " " #op " " #b, check_a, check_b); \
  } while (false)
#define ML_CHECK_EQ(a, b) ML_CHECK_THAT(::ml::check_detail::equal(check_a, check_b), a, ==, b)
#define ML_CHECK_NE(a, b) ML_CHECK_THAT(!::ml::check_detail::equal(check_a, check_b), a, !=, b)
#define ML_CHECK_LT(a, b) ML_CHECK_THAT(::ml::check_detail::less(check_a, check_b), a, <, b)
#define ML_CHECK_LE(a, b) ML_CHECK_THAT(!::ml::check_detail::less(check_b, check_a), a, <=, b)
#define ML_CHECK_GT(a, b) ML_CHECK_THAT(::ml::check_detail::less(check_b, check_a), a, >, b)
#define ML_CHECK_GE(a, b) ML_CHECK_THAT(!::ml::check_detail::less(check_a, check_b), a, >=, b)

#ifdef NDEBUG
// What is checked is compiled, and not run.
#define ML_DCHECK_ONLY(check) static_cast<void>(sizeof([&] { check; }))
#else
#define ML_DCHECK_ONLY(check) check
#endif
#define ML_DCHECK(condition) ML_DCHECK_ONLY(ML_CHECK(condition))
#define ML_DCHECK_LT(a, b) ML_DCHECK_ONLY(ML_CHECK_LT(a, b))
#define ML_DCHECK_LE(a, b) ML_DCHECK_ONLY(ML_CHECK_LE(a, b))
