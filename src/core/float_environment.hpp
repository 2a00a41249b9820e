#pragma once

#if !defined(__SSE2__)
#include <cfenv>
#endif

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "lanescape needs IEEE arithmetic: compile it without -ffast-math and -ffinite-math-only"
#endif

namespace lanescape {

// The floating-point environment that the library relies on: rounding to nearest, no traps, gradual underflow. It holds for this
// thread while the object lives; then the host gets its own back, exception flags included. Kernels divide by zero in lanes that
// are masked out, and on SSE2 they round by adding a large number. Costs ten instructions where the host has changed nothing.
class FloatEnvironment {
 public:
#if defined(__SSE2__)
  FloatEnvironment() : host_(__builtin_ia32_stmxcsr()) {
    if (is_foreign()) __builtin_ia32_ldmxcsr(standard);
  }
  ~FloatEnvironment() {
    if (is_foreign()) __builtin_ia32_ldmxcsr(host_);
  }
#else
  FloatEnvironment() {
    std::feholdexcept(&host_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~FloatEnvironment() { std::fesetenv(&host_); }
#endif
  FloatEnvironment(const FloatEnvironment&) = delete;
  FloatEnvironment& operator=(const FloatEnvironment&) = delete;

 private:
#if defined(__SSE2__)
  static constexpr unsigned standard = 0x1f80, flags = 0x3f;  // of MXCSR
  bool is_foreign() const { return (host_ & ~flags) != standard; }
  unsigned host_;
#else
  std::fenv_t host_;
#endif
};

}  // namespace lanescape
