using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Verp {
  /// <summary>A call failed; Message gives the reason. If a controller threw, InnerException is its
  /// exception.</summary>
  public sealed class VerpException : Exception {
    public VerpException(verp_status status, string message, Exception inner = null) : base(message, inner) {
      Status = status;
    }
    public verp_status Status { get; }

    /// <summary>For errors found before the library is called; `why` names the call.</summary>
    internal static VerpException Wrong(string why) { return new VerpException(verp_status.VERP_BAD_ARGUMENT, why); }

    /// <summary>Call it right after the library's call, on the same thread.</summary>
    internal static unsafe int Checked(int status) {
      if (status < 0) throw new VerpException((verp_status)status, Texts.Of(Native.verp_last_error()));
      return status;
    }
  }

  /// <summary>C strings: UTF-8 with a final zero.</summary>
  static class Texts {
    public static byte[] ToC(string text, string what) {
      if (text == null) return null;
      if (text.IndexOf('\0') >= 0) throw VerpException.Wrong(what + " has a zero character in it");
      return Encoding.UTF8.GetBytes(text + '\0');
    }
    public static unsafe string Of(byte* text, int most = int.MaxValue) {
      int length = 0;
      while (length < most && text[length] != 0) ++length;
      return new string((sbyte*)text, 0, length, Encoding.UTF8);
    }
  }

  /// <summary>A library handle, closed once, by Dispose() or the finalizer. Calls with a closed handle, or with one that
  /// another thread uses, throw VerpException.</summary>
  public abstract class Handle : SafeHandle {
    protected Handle() : base(IntPtr.Zero, true) {
      if (Native.verp_abi() != Native.Abi || !Native.SizesAreThose())
        throw new VerpException(verp_status.VERP_FAILED, Native.Library + " has ABI " + Native.verp_abi() +
                                ", this binding is for " + Native.Abi);
    }

    public override bool IsInvalid { get { return handle == IntPtr.Zero; } }

    protected abstract int CloseNow();
    protected virtual void LetGo() {}

    /// <summary>Throws if a callback or another thread uses the handle, which then stays open, and if a trace cannot be
    /// completed.</summary>
    protected override void Dispose(bool disposing) {
      if (!disposing || IsClosed || IsInvalid) {
        base.Dispose(disposing);
        return;
      }
      int status = CloseNow();
      if (status != (int)verp_status.VERP_BUSY) {
        SetHandleAsInvalid();
        LetGo();
      }
      Checked(status);
    }

    protected override bool ReleaseHandle() {
      bool closed = CloseNow() >= 0;
      LetGo();
      return closed;
    }

    /// <summary>An instance method, so that this object lives until its call returns.</summary>
    protected int Checked(int status) {
      try {
        return VerpException.Checked(status);
      } finally {
        GC.KeepAlive(this);
      }
    }
  }
}
