// SPDX-License-Identifier: BSD-3-Clause
/// A machine with less memory, for the tests.
#ifndef SpectralWatermark_Testing_AddressSpace_h
#define SpectralWatermark_Testing_AddressSpace_h

#include <sys/resource.h>
#include <unistd.h>

#include <fstream>

/// Sanitizers take terabytes of addresses for themselves, and no limit can be set.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SPECTRALWATERMARK_NO_ADDRESS_LIMIT 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define SPECTRALWATERMARK_NO_ADDRESS_LIMIT 1
#endif
#endif

/// While it lives, the process may take so many bytes more.
class AddressSpaceLimit
{
public:
  explicit AddressSpaceLimit(double bytes)
  {
    double pages = 0.0;
    std::ifstream("/proc/self/statm") >> pages;
    getrlimit(RLIMIT_AS, &this->Before);
    rlimit less = this->Before;
    less.rlim_cur = static_cast<rlim_t>(pages * static_cast<double>(sysconf(_SC_PAGESIZE)) + bytes);
    this->IsSet = setrlimit(RLIMIT_AS, &less) == 0;
  }
  ~AddressSpaceLimit() { setrlimit(RLIMIT_AS, &this->Before); }
  AddressSpaceLimit(const AddressSpaceLimit&) = delete;
  void operator=(const AddressSpaceLimit&) = delete;

  bool Holds() const { return this->IsSet; }

private:
  rlimit Before{};
  bool IsSet = false;
};

#endif
