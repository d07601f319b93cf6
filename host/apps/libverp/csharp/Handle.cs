using System;
using System.Runtime.InteropServices;
using System.Text;

namespace Verp {
  /// <summary>A call that failed: Message names it and says why. Of a controller that threw, InnerException is what it
  /// threw.</summary>
  public sealed class VerpException : Exception {
    public VerpException(verp_status status, string message, Exception inner = null) : base(message, inner) {
      Status = status;
    }
    public verp_status Status { get; }

    /// <summary>Of what the library was not asked; `why` names the call.</summary>
    internal static VerpException Wrong(string why) { return new VerpException(verp_status.VERP_BAD_ARGUMENT, why); }

    /// <summary>To be called right after the call, in its thread.</summary>
    internal static unsafe int Checked(int status) {
      if (status < 0) throw new VerpException((verp_status)status, Texts.Of(Native.verp_last_error()));
      return status;
    }
  }

  /// <summary>Texts as C has them: UTF-8 with a zero at the end.</summary>
  static class Texts {
    /// <summary>`what` names the call and its argument.</summary>
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

  /// <summary>A handle of the library's: closed once, by Dispose(), or when nobody has it any more. The library knows a closed
  /// one, and one that another thread is using: such calls throw VerpException.</summary>
  public abstract class Handle : SafeHandle {
    protected Handle() : base(IntPtr.Zero, true) {
      if (Native.verp_abi() != Native.Abi || !Native.SizesAreThose())
        throw new VerpException(verp_status.VERP_FAILED, Native.Library + " has ABI " + Native.verp_abi() +
                                ", this binding is for " + Native.Abi);
    }

    public override bool IsInvalid { get { return handle == IntPtr.Zero; } }

    /// <summary>The library's call.</summary>
    protected abstract int CloseNow();
    /// <summary>What the library has looked at until now is let go.</summary>
    protected virtual void LetGo() {}

    /// <summary>Throws if a callback or another thread is using it, and then it stays open; and if a trace could not become
    /// whole.</summary>
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

    /// <summary>Nobody has it any more.</summary>
    protected override bool ReleaseHandle() {
      bool closed = CloseNow() >= 0;
      LetGo();
      return closed;
    }

    /// <summary>Of an instance, so that this one lives until its call is over.</summary>
    protected int Checked(int status) {
      try {
        return VerpException.Checked(status);
      } finally {
        GC.KeepAlive(this);
      }
    }
  }
}
